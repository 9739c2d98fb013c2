"""The commands of the command line, a module each, and the options that they share."""
