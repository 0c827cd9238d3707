"""A publication run again: its figures, and every number it prints beside ours, in one report.

`reported_values.json` is all that is known of the publication: the scene that stands for its
mechanism, and what it prints, each with its location. The rest follows from it, in this order:

1. `reported` reads the document, `variants` says how what is not printed was chosen.
2. `cases` turns both into jobs, `reproduction` computes them on all cores.
3. `peaks`, `ranges` and `motions` set our numbers beside the printed ones.
4. `pictures` draws, `report` puts everything into one page, on `template.html`.
"""
