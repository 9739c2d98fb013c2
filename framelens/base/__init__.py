"""What everything stands on: errors, arguments, whole files, fonts, texts, progress."""
