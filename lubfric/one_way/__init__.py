"""Load sharing one way: a film in the gap of the dry contact."""
