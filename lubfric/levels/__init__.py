"""How much of the film, of the contact and of the grids a friction coefficient needs."""
