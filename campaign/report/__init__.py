"""The answer in words, figures and a page."""
