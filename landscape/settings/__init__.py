"""How settings are declared, read and checked, and notices about those without effect."""
