"""Calibration: parameters of a scene that make its peaks those that were measured.

`kinds.admit_calibration` checks a document, `measure.Measurement` computes what candidates give,
`calibrate.calibrate` searches and returns an `outcome.Outcome`: what fits best, and the spread of
what fits equally well.  Impacts make the objective rough, so that a best value alone says little.
"""
