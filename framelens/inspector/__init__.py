"""The inspector: a panel over a frame that lists its calls and changes them."""
