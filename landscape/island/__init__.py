"""The island of the report: its draw order, views and fixes."""
