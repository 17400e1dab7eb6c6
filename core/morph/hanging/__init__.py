"""Layers that hang on others: carried along by them, and joined to them between keys."""
