"""The inverse of the vibration test."""
