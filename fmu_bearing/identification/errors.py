"""What `identify` refuses."""


class IdentifyError(ValueError):
    """Data, free keys or settings that are refused; the message has one line per problem."""
