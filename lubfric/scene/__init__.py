"""What is asked: bodies, surfaces, lubricant, motion and numerics, from a file or from Python."""
