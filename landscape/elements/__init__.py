"""The island's elements: one file and one technique each, plain array functions above the class."""
