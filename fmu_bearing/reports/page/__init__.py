"""The page: parts of a section as data, their style, and what makes HTML of them.

``blocks``   parts of a section: words, tables, charts, sounds; fewer points with all peaks
``look``     colours, fonts, an empty figure
``packing``  figures and the plotting library as compressed text
``render``   the page from its sections

The page is ``page.html.j2``, ``page.css`` and ``page.js``; ``shapes.js`` moves the shapes of modes.
"""
