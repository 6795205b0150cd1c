"""Economical steps of moving roughness against the tight one, on random rolling contacts.

``python -m verification.campaigns.moving_effort COUNT [--budget S]`` extends the table, one case after another.
"""
