"""The page at ``/``: HTML, styles and ES modules, sent to browsers as they are.

`views` has one module for each thing that can be looked at, named as in the address; `mechanism`
places, draws and animates a scene; `plots` draws curves and clouds; `interface` has what several
views are made of; `requests` speaks to the service; `vendor` is what others wrote, with licences
and checksums.
"""
