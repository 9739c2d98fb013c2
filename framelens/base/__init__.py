"""The ground floor, used by all rooms: errors, arguments, files, fonts, texts, progress."""
