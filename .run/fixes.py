"""What to do about the errors of Blender's own that a person meets most: it names none."""

FIXES = {
    "no camera": "add one to the scene (Add > Camera) and save the file",
    "Image too small": "raise the resolution or its percentage, or draw a larger render region",
    "Missing DNA block": "the file is cut off: copy it again, or take the backup beside it, the .blend1",
    "not supported in file": "name a .blend that Blender has saved",
}


def with_fix(error: str) -> str:
    """An error's text as Blender raises it, in the form "Error: what is wrong. Fix: what to do"."""
    text = error.strip().removeprefix("Error: ")
    fix = next((fix for part, fix in FIXES.items() if part in text), None)
    return f"Error: {text.rstrip('.')}. Fix: {fix}" if fix and "Fix: " not in text else f"Error: {text}"
