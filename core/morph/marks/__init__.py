"""From two rings to the marks that they need, in the order of the work.

``contour`` says what is compared, ``misfit`` how, ``alignment`` where to begin; ``elastic`` finds
the cheapest path through the misfits and ``matching`` improves it; ``keymarks`` boils it down to
marks, ``rings`` and ``holes`` bring it back to what was drawn.
"""
