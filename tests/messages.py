"""Messages are held to what they name, not to their sentences: key, value, limit, way out."""


def says(text, expected):
    """Whether the parts of ``expected`` between `` ... `` stand in a message, in their order."""
    place = 0
    for part in expected.split(" ... "):
        found = text.find(part, place)
        if found < 0:
            return False
        place = found + len(part)
    return True
