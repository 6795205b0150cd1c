"""Coverage of moving answers: how often the numerical and sampling error of one strip holds f of the endless line.

``python -m verification.campaigns.moving_coverage [--answers N] [--random A B] [--workers N]`` extends both tables.
"""
