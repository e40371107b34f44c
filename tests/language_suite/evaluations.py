"""Evaluates designs by scadray and by the installed openscad, and cuts down those that differ."""

import os
import subprocess

# What the installed openscad speaks.
os.environ.setdefault("SCADRAY_LANGUAGE", "2021.01")


def run(command, folder, limit_s, **environment):
    """Returns the exit status, None after the time limit, and the messages. (On standard output openscad
    writes the characters that no token has.)"""
    try:
        said = subprocess.run(command, cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                              stderr=subprocess.PIPE, timeout=limit_s, env={**os.environ, **environment})
    except subprocess.TimeoutExpired:
        return None, b"takes too long"
    return said.returncode, said.stderr


def answers(program, design, out, folder, options=(), limit_s=60, **environment):
    """Returns what scadray and openscad, started in a folder, make of a design: the exit status, None after
    the time limit, the messages, and the tree, None if there is none. The file `out` is overwritten."""
    made = []
    for command in ([program, "--evaluator=own"], ["openscad"]):
        if os.path.exists(out):
            os.remove(out)
        said = run([*command, "-o", out, *options, design], folder, limit_s, **environment)
        tree = None
        if os.path.exists(out):
            with open(out, "rb") as file:
                tree = file.read()
        made.append((*said, tree))
    return made


def cut_down(text, is_enough):
    """Cuts pieces out of a text as long as what is left is enough."""
    length = len(text)
    while length > 0:
        at = 0
        while at < len(text):
            shorter = text[:at] + text[at + length:]
            if is_enough(shorter):
                text = shorter
            else:
                at += length
        length //= 2
    return text
