"""Tools: trace, doctor, benchmarks, asset checks, rendering many stills."""
