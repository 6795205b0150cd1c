"""The studies that compare `lubfric` with finite elements and closed forms; `verification.catalogue` lists them."""
