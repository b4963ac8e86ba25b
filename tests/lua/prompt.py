#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""prompt.py LACUNA FOLDER: the prompt at a terminal: completion, several lines, Ctrl-C, history; progress."""
import os
import pathlib
import pty
import select
import signal
import sys
import time

PATIENCE = 20  # [s] for an answer, on a machine that is busy with other things
SKIPPED = 77  # the exit code that the list of tests knows


class Terminal:
    def __init__(self, *words):
        self.told = ""
        try:
            self.process, self.terminal = pty.fork()
        except OSError as error:  # a container without /dev/pts
            print("no terminal can be had here (%s): the prompt is not tested" % error)
            sys.exit(SKIPPED)
        if self.process == 0:
            os.execv(words[0], words)

    def wait_for(self, text):
        """Read until `text` is there, which is passed over."""
        end = time.time() + PATIENCE
        while text not in self.told:
            if not select.select([self.terminal], [], [], max(0, end - time.time()))[0]:
                sys.exit("'%s' did not come; there is: %r" % (text, self.told))
            try:
                self.told += os.read(self.terminal, 4096).decode(errors="replace")
            except OSError:
                sys.exit("'%s' did not come, and the program ended: %r" % (text, self.told))
        self.told = self.told[self.told.index(text) + len(text):]

    def type(self, text):
        os.write(self.terminal, text.encode())

    def say(self, line, answer):
        """Type a line until it is answered: a Ctrl-C that is met late gives up what is typed after it."""
        for _ in range(3):
            self.type(line)
            end = time.time() + PATIENCE / 3
            while answer not in self.told and select.select([self.terminal], [], [], max(0, end - time.time()))[0]:
                self.told += os.read(self.terminal, 4096).decode(errors="replace")
            if answer in self.told:
                break
        self.wait_for(answer)

    def interrupt(self, text):
        """Ctrl-C until `text` is there: one that comes while no key is waited for gives up the line later."""
        end = time.time() + PATIENCE
        while text not in self.told and time.time() < end:
            self.type("\x03")
            # One may be met late, and its answer may come in parts: a second one at once would end the program.
            again = time.time() + 4
            while text not in self.told and select.select([self.terminal], [], [],
                                                          max(0, again - time.time()))[0]:
                self.told += os.read(self.terminal, 4096).decode(errors="replace")
        self.wait_for(text)
        time.sleep(0.3)  # for the last one to be met before anything runs
        self.told = ""

    def end(self):
        """Until the program has ended by itself."""
        end = time.time() + PATIENCE
        while time.time() < end:
            try:
                if select.select([self.terminal], [], [], 0.1)[0]:
                    self.told += os.read(self.terminal, 4096).decode(errors="replace")
            except OSError:
                pass  # it has ended
            done, status = os.waitpid(self.process, os.WNOHANG)
            if done:
                return os.waitstatus_to_exitcode(status)
        os.kill(self.process, signal.SIGKILL)
        sys.exit("the program did not end: %r" % self.told)

    def close(self):
        """Ctrl-D on an empty line until the program has ended: one while no key is waited for is lost."""
        end = time.time() + PATIENCE
        while time.time() < end:
            try:
                self.type("\r\x04")
                if select.select([self.terminal], [], [], 0.3)[0]:
                    self.told += os.read(self.terminal, 4096).decode(errors="replace")
            except OSError:
                pass  # it has ended
            done, status = os.waitpid(self.process, os.WNOHANG)
            if done:
                return os.waitstatus_to_exitcode(status)
            time.sleep(0.05)
        os.kill(self.process, signal.SIGKILL)
        sys.exit("the program did not end")


def main():
    lacuna, folder = os.path.abspath(sys.argv[1]), pathlib.Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    os.chdir(folder)
    home, history = folder / "home", folder / "history"
    home.mkdir(exist_ok=True)
    history.unlink(missing_ok=True)
    (folder / "only_one.stl").touch()
    os.environ["HOME"], os.environ["TERM"] = str(home), "xterm"
    os.environ.pop("LACUNA_HISTORY", None)

    terminal = Terminal(lacuna, "--history", str(history), "-i")
    terminal.wait_for("> ")
    # Fields, calls, options of a call, files in quotes, words of help: each has one way to go on.
    for typed, completed, rest, answer in (
            ("lacuna.synthe\t", "tic", ".prism {} \r", "Model of 8 faces"),
            ("lacuna.synthetic.pris\t", "m", " {} \r", "Model of 8 faces"),
            ("lacuna.synthetic.prism { side\t", "s = ", "3 }\r", "Model of 5 faces"),
            ("lacuna.load 'only\t", "_one.stl", "'\r", "is empty"),
            ("help 'describ\t", "e", "'\r", "Model:describe")):
        terminal.type(typed)
        terminal.wait_for(completed)
        terminal.type(rest)
        terminal.wait_for(answer)
        terminal.wait_for("> ")
    # A statement that goes on, one that is given up, a line that is, and work that is stopped.
    terminal.type("for i = 1, 2 do\r")
    terminal.wait_for(">> ")
    terminal.type("print('line ' .. i) end\r")
    terminal.wait_for("line 2")
    terminal.type("do\r")
    terminal.wait_for(">> ")
    terminal.interrupt("\n> ")
    terminal.type("nonsense nonsense")
    terminal.wait_for("nonsense nonsense")
    terminal.interrupt("\n> ")
    terminal.say("print('rea' .. 'dy') while true do end\r", "ready")
    terminal.type("\x03")
    terminal.wait_for("interrupted")  # of one: a second would end the program
    terminal.wait_for("> ")
    terminal.type("'still ' .. 'here'\r")
    terminal.wait_for("still here")
    terminal.wait_for("> ")
    if terminal.close() != 0:
        sys.exit("Ctrl-D is no failure")
    for word in ("exit", "quit()"):
        terminal = Terminal(lacuna, "-i")
        terminal.wait_for("> ")
        terminal.type(word + "\r")
        if terminal.end() != 0:
            sys.exit(word + " is no failure")
    # How many cells are expected is told with the progress.
    (folder / "many.lua").write_text("""local lacuna = require "lacuna"
local void = lacuna.synthetic.prism { sides = 4, radius = 2 ^ 0.5 }:open_volume {}
void:sweep_to("many.msh", { size = 0.0025, layers = 100 })""")
    terminal = Terminal(lacuna, "many.lua")
    terminal.wait_for("lacuna: about 64 million cells: ")
    terminal.type("\x03")
    terminal.wait_for("interrupted")
    if terminal.end() != 130 or (folder / "many.msh").exists():
        sys.exit("a sweep that is stopped leaves nothing")
    if "still" not in history.read_text():
        sys.exit("the history was not kept")
    if list(home.iterdir()):
        sys.exit("something was written to the home folder")
    print("all of it works")


main()
