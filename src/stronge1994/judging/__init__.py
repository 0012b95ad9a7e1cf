"""How far curves are from what they are compared with, and the verdict on it."""
