"""New runs of a site: talus-dda with keys given from Python, its messages as Python's own.

The tools are those of the search path. Outputs, checkpoints and the registry are theirs, so a run made here
has the bytes of one made in a shell.
"""
import json
import os
import signal
import subprocess
import warnings

from .runs import open_run


class Site:
    """A site file, and keys that override it: Site("site.toml", solver__duration_s=5), site["solver.seed"] = 2."""

    def __init__(self, path, **keys):
        self.path = os.fspath(path)
        self.keys = {}
        for key, value in keys.items():
            self[key.replace("__", ".")] = value

    def __setitem__(self, key, value):
        self.keys[key] = value

    def with_keys(self, **keys):
        """The same site with further keys; this one stays as it is."""
        site = Site(self.path)
        site.keys = self.keys | Site(self.path, **keys).keys
        return site

    def words(self):
        """Arguments of a tool that reads the site file."""
        return [self.path] + [f"--set={key}={_toml(value)}" for key, value in self.keys.items()]


def run(site, trn, blocks, out, *options, progress=None, **keys):
    """Makes one run, and returns it (open_run).

    `site`: a Site, or the path of its file. `trn`, `blocks`: files of talus-trn and talus-blocks. `options`: words
    of talus-dda, e.g. "--settle", "--overwrite". `progress`: called with the share that is done, twice a
    second; an exception of it ends the run. `keys` override the site file: ground__scree__friction_deg=32.

    Warnings of the tool are UserWarnings. Raises ValueError with its message for inputs that cannot be used. A run
    that broke a limit of its health is returned, with a warning that says so. Interrupted (Ctrl-C), talus-dda
    writes its checkpoint; "--resume" continues from there.
    """
    site = (site if isinstance(site, Site) else Site(site)).with_keys(**keys)
    command = ["talus-dda", *site.words(), "--trn", os.fspath(trn), "--blocks", os.fspath(blocks), "-o",
               os.fspath(out), "--messages=json", "--progress=json", *options]
    # A session of its own: an interruption reaches it once, from here. The second one would kill it.
    with subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                          text=True, start_new_session=True) as tool:
        said = []
        try:
            for line in tool.stderr:
                said += _take(line, progress)
        except BaseException:
            tool.send_signal(signal.SIGINT)
            tool.stderr.read()
            raise
    if tool.returncode not in (0, 3):
        raise ValueError("\n".join(said) or f"talus-dda ended with exit code {tool.returncode}")
    if said:
        warnings.warn("\n".join(said), stacklevel=2)
    return open_run(out)


def _take(line, progress):
    """Hands progress on and shows warnings; returns the exception that ended the run."""
    try:
        message = json.loads(line)
    except ValueError:
        return [line.rstrip()]
    if "progress" in message:
        if progress is not None:
            progress(message["progress"])
    elif message["level"] == "warning":
        warnings.warn(message["text"], stacklevel=3)
    elif message["level"] in ("error", "hint"):
        return [message["text"]]
    return []


def _toml(value):
    """A value as --set takes it: text without quotes, true and false, numbers and lists as TOML has them."""
    return value if isinstance(value, str) else json.dumps(value)
