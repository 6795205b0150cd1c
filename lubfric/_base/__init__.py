"""What every room uses: checks of input, repr, text tables, files, figures."""
