# SPDX-License-Identifier: MIT
"""A job of Lacuna in a process of its own: started, asked how far it is, stopped. See worker.py."""
import json
import os
import shutil
import subprocess
import tempfile
import threading
import time

import FreeCAD

WORKER = os.path.join(os.path.dirname(os.path.abspath(__file__)), "worker.py")
running = []  # jobs that have a process


class Failed(Exception):
    """A job ended without what was asked for.

    faces     numbers of FreeCAD's faces that the message is about
    attempts  why what was tried instead failed too
    """

    def __init__(self, message, code, faces=(), attempts=()):
        super().__init__(message)
        self.code = code
        self.faces = list(faces)
        self.attempts = list(attempts)


def python():
    """The Python that has the package `lacuna`: that which the environment or the script `install` names."""
    named = os.path.join(os.path.dirname(os.path.dirname(WORKER)), "python")
    if "LACUNA_PYTHON" in os.environ or not os.path.exists(named):
        return os.environ.get("LACUNA_PYTHON", "/usr/bin/python3")
    with open(named) as file:
        return file.read().strip()


class Job:
    """`request` is data for worker.py, `shape` the part; `document` is that whose end stops the job."""

    def __init__(self, shape, request, document=None):
        self.document = document
        self.stage, self.share = "starting", 0.0
        self.folder = tempfile.mkdtemp(prefix="lacuna-")
        shape.exportBrep(self.path("part.brep"))
        with open(self.path("request.json"), "w") as file:
            json.dump(request, file)
        try:
            with open(self.path("messages"), "w") as messages:
                self._process = subprocess.Popen([python(), WORKER, self.folder], stdin=subprocess.PIPE,
                                                 stdout=subprocess.PIPE, stderr=messages, text=True)
        except OSError as error:
            shutil.rmtree(self.folder, ignore_errors=True)
            raise Failed(f"The Python of the job does not start: {error}. Name another with "
                         "hosts/freecad/install --python.", "freecad.no_python") from None
        self._reader = threading.Thread(target=self._read_progress, daemon=True)
        self._reader.start()
        running.append(self)

    def path(self, name):
        return os.path.join(self.folder, name)

    @property
    def process(self):
        return self._process.pid

    def done(self):
        return self._process.poll() is not None

    def wait(self, seconds=None):
        """@return whether it is done, after at most so many seconds"""
        try:
            self._process.wait(seconds)
        except subprocess.TimeoutExpired:
            return False
        return True

    def stop(self):
        """Nothing of it is left, neither the process nor its files."""
        if self in running:
            running.remove(self)
        self._process.kill()
        self._process.wait()
        self._process.stdin.close()
        shutil.rmtree(self.folder, ignore_errors=True)

    def result(self):
        """What worker.py answered, once it is done. `close` is still to be called.

        @raise Failed  an error of Lacuna, or the process ended without an answer
        """
        if not os.path.exists(self.path("result.json")):
            if not os.path.isdir(self.folder):
                raise Failed("The job was stopped.", "core.cancelled")
            with open(self.path("messages")) as file:
                lines = file.read().strip().splitlines() or [f"exit code {self._process.returncode}"]
            raise Failed(f"The process of Lacuna ended without an answer: {lines[-1]}", "freecad.ended")
        with open(self.path("result.json")) as file:
            result = json.load(file)
        for note in result.get("notes", []):
            FreeCAD.Console.PrintWarning(f"Lacuna: {note}\n")
        if "error" in result:
            error = result["error"]
            raise Failed(error["message"], error["code"], error["faces"], error["attempts"])
        return result

    def _read_progress(self):
        for line in self._process.stdout:
            self.stage, self.share = json.loads(line)


class StopWithDocument:
    """Closing a document stops its jobs."""

    def slotDeletedDocument(self, document):
        for job in [job for job in running if job.document == document.Name]:
            job.stop()


FreeCAD.addDocumentObserver(StopWithDocument())
