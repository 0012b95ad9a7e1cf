"""For PyInstaller, which makes one file of a program: it finds this folder by an entry point."""


def hook_dirs() -> list[str]:
    """Folders of hooks."""
    return [*__path__]
