"""Layers that hang on others: carried along by them, and joined to them between keys.

A part that turns by itself has to be such a layer: within one outline none can, unless it folds.
Where F₁ = R₁ S₁ and F₂ = R₂ S₂ of two triangles take the edge e that they share to one image, with
S₁ and S₂ positive definite, both R turn e to within a right angle of that image, so that they are
less than half a turn apart. In a motion without folds this holds at every moment; so the angles of
all triangles, followed from the start, hang together, and whole turns belong to the outline whole.
"""
