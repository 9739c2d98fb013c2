"""One module for each way to a context; context.py chooses among them."""
