"""tribo: simulate wear, with every model a plugin."""
