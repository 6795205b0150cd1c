"""The answer at one speed: the sample of the surface, the models, the interval of f."""
