"""Why is my screen black: the cause of what a frame does not show, found by trying.

In the order in which they work: survey.py walks the frame once and takes the numbers of each draw,
with geometry.py for its vertices; the rules (rules_*.py) look at these numbers and suspect causes,
each with a change that would mend it; trial.py draws the frame again with the change; diagnosis.py
keeps those whose change is seen in the picture, the likeliest first. findings.py is the table of
all causes, with their texts.
"""
