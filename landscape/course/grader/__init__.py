"""How an exercise is graded: a sandbox, the program's evidence, tests and hints."""
