"""Coverage of moving answers: how often the numerical and sampling error of one strip holds f of the endless line.

``python -m verification.campaigns.moving_coverage [--seeds N] [--budget S]`` extends both tables, one solve after another.
"""
