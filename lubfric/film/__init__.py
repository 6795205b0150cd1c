"""The smooth film of a line contact: closed forms, EHL, heat."""
