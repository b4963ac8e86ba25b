# SPDX-License-Identifier: MIT
"""The package as a program in Python meets it: values, errors, callbacks, signals, threads, memory."""
import copy
import ctypes
import gc
import logging
import os
import pathlib
import pickle
import random
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import unittest.mock
import weakref

try:
    import numpy
except ImportError:
    print("left out: numpy is not installed")
    sys.exit(77)

import lacuna


def resident():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def prism(**options):
    options = {"sides": 4, "drop": "walls", **options}
    return lacuna.synthetic.prism(**options).open_volume(source="source", target="target")


def objects_left():
    """How many objects live in this thread's interpreter."""
    library = lacuna._library._library
    handle = ctypes.c_void_p(lacuna._library.own_interpreter()._handle)
    kept = lacuna.synthetic.prism()  # what was dropped before a call is released before it
    count = ctypes.c_int64()
    text = b"left = 0 for _ in pairs(lacuna_python.objects) do left = left + 1 end"
    library.lacuna_run_string(handle, text, len(text), None)
    library.lacuna_get_integer(handle, b"left", ctypes.byref(count))
    del kept
    return count.value - 1


class Values(unittest.TestCase):
    def test_import_takes_a_tenth_of_a_second_at_most(self):
        code = "import time; t = time.process_time(); import lacuna; print(time.process_time() - t)"
        with tempfile.TemporaryDirectory() as folder:  # compiled once, as when installed
            environment = dict(os.environ, PYTHONPYCACHEPREFIX=folder)
            environment.pop("PYTHONDONTWRITEBYTECODE", None)
            taken = [float(subprocess.check_output([sys.executable, "-c", code], env=environment))
                     for _ in range(4)]
        self.assertLess(min(taken[1:]), 0.1, taken)

    def test_words_of_the_recipe_language(self):
        part = lacuna.synthetic.prism(sides=6, drop=["wall_1"])
        void = part.open_volume(source="source", target="target", walls="auto")
        self.assertEqual(void.class_, "III")
        closure = void.close(edge_shape="straight")
        self.assertIsInstance(closure, lacuna.Closure)
        self.assertEqual((closure.void_faces, closure["void_faces"], closure.watertight), (1, 1, True))
        mesh = void.sweep(layers=3, size=0.4)
        self.assertEqual(mesh.layers, 3)
        self.assertEqual(mesh.hexes % 3, 0)
        self.assertEqual([len(mesh.hex(1)), len(mesh.node(1))], [8, 3])
        self.assertEqual({type(group.name) for group in mesh.groups()}, {str})
        self.assertEqual(str(mesh.report), "\n".join(mesh.report))
        self.assertIn("layers", mesh.report.seconds)
        self.assertEqual(set(mesh.fidelity.faces), {1, 2, 3, 4, 5, 6, 7, "void:1"})
        self.assertIsInstance(mesh.fidelity.faces[1], lacuna.FaceFidelity)
        quality = mesh.quality()
        self.assertTrue(quality.certified)
        self.assertEqual(quality.metrics["scaled_jacobian"].min, quality.min_scaled_jacobian)
        self.assertEqual(list(quality.metrics)[0], "scaled_jacobian")
        self.assertIn("hexahedra", str(quality))
        self.assertEqual(part.face(3), part.face("wall_2"))
        self.assertEqual(part.face(near=(0, 0, 0)), part.face(1))
        self.assertEqual(len({part.face(3), part.face("wall_2"), part.face(4)}), 2)
        self.assertEqual(part.faces(name="nobody"), [])
        whole = lacuna.synthetic.barrel()
        self.assertEqual(whole.open_volume().class_, "closed")
        self.assertEqual(prism().free_edges()[0].from_, prism().free_edges()[0]["from"])
        self.assertRegex(lacuna.version, r"^\d+\.\d+\.\d+$")
        self.assertIsNone(part.info().faces[0].half_angle)
        self.assertEqual(type(void).__module__, "lacuna")

    def test_quads_copies_and_patterns(self):
        shell = lacuna.synthetic.prism(sides=4).quads(faces=["source", "wall_1"], size=0.5)
        self.assertIsInstance(shell, lacuna.QuadMesh)
        self.assertEqual((shell.hexes, shell.layers, shell.cells().shape), (0, 0, (shell.quads, 4)))
        self.assertEqual(shell.coordinates().shape, (shell.nodes, 3))
        self.assertGreater(shell.quality().min_scaled_jacobian, 0.5)
        void = shell.model().open_volume(source="source", along={"vector": (0, 0, -1)})
        mesh = void.sweep(layers=2)
        self.assertEqual(void.class_, "0")
        row = mesh.pattern(translate=(0, 0, 1), count=3)
        self.assertEqual(row.hexes, 3 * mesh.hexes)
        half = mesh.copy(mirror=((0, 0, 0), (0, 0, 1)), name="upper")
        both = lacuna.assembly([mesh, half]).sweep()
        self.assertLess(both.nodes, 2 * mesh.nodes)
        with self.assertRaisesRegex(lacuna.Error, "assembly.overlap"):
            mesh.pattern(translate=(0, 0, 0.3), count=2)

    def test_a_generator_is_a_list(self):
        part = lacuna.synthetic.prism(sides=6, drop=["wall_1"])
        for walls in ((face for face in part.faces() if face.name.startswith("wall")),
                      map(part.face, [f"wall_{i}" for i in range(2, 7)])):
            void = part.open_volume(source="source", target="target", walls=walls)
            self.assertIn("7 faces", str(void))

    def test_scalars_of_numpy(self):
        mesh = prism().sweep(layers=numpy.array(2), size=numpy.array(0.5), wedges=numpy.True_)
        self.assertEqual(mesh.layers, 2)

    def test_faces_of_a_closed_volume_go_by_tag(self):
        mesh = lacuna.synthetic.barrel().open_volume().sweep(layers=3, size=0.8)
        self.assertEqual(set(mesh.fidelity.faces), {1, 2, 3})

    def test_a_selection_that_finds_nothing_is_refused_by_its_words(self):
        barrel = lacuna.synthetic.barrel(bulge=0.3)
        nothing = barrel.faces(kind="cylinder")
        self.assertEqual(nothing, [])
        for walls in (nothing, nothing + barrel.faces(kind="cone"), {"kind": "cylinder"}):
            with self.assertRaises(lacuna.Error) as caught:
                barrel.open_volume(source="source", target="target", walls=walls)
            self.assertEqual(caught.exception.code, "lua.bad_value")
        self.assertEqual(nothing + [1], [1])
        self.assertEqual(barrel.open_volume(source="source", target="target", walls=[]).class_, "I")

    def test_options_may_be_a_dict_and_keywords_win(self):
        self.assertEqual(prism().sweep({"layers": 2, "size": 0.5}, layers=3).layers, 3)
        above = lacuna.synthetic.prism(sides=4)
        low, high = above.open_volume(source=1, target=2, walls="auto").cut(plane=[(0, 0, 1), (0, 0, 1)])
        mesh = lacuna.assembly([low, high]).sweep({low: {"layers": 4}, high: {"layers": 2}}, size=0.5)
        self.assertEqual(sorted(mesh.layers.values()), [2, 4])
        self.assertEqual(set(mesh.fidelity.regions), set(mesh.regions))
        self.assertEqual(len(mesh.cells()), mesh.hexes)
        for none in mesh.cells("tet"), prism().sweep(layers=1, size=0.5).cells("tet"):
            self.assertEqual((none.shape, none.dtype), ((0, 4), numpy.int32))
        with tempfile.TemporaryDirectory() as folder:
            mesh._write_bare(os.path.join(folder, "a.msh"))
            self.assertEqual(lacuna.check(os.path.join(folder, "a.msh")).hexes, mesh.hexes)

    def test_fields_are_views_in_the_order_of_the_cells(self):
        mesh = prism(sides=6, twist=40).sweep(layers=4, size=0.3)
        values = mesh.field()
        self.assertEqual((values.shape, values.dtype), ((mesh.hexes,), numpy.float64))
        self.assertFalse(values.flags.writeable)
        quality = mesh.quality()
        self.assertAlmostEqual(values.min(), quality.min_scaled_jacobian, 6)  # of single precision
        for name, summary in quality.metrics.items():
            self.assertAlmostEqual(mesh.field(name).max() / summary.max, 1, 6, name)
        pieces = lacuna.synthetic.prism(sides=4).open_volume(source=1, target=2, walls="auto").cut(
            plane=[(0, 0, 1), (0.1, 0, 1)])
        for each in mesh, lacuna.assembly(pieces).sweep(layers=2, size=0.5):
            corners = each.coordinates()[each.cells() - 1]
            axes = [corners[:, ahead].sum(axis=1) - corners[:, behind].sum(axis=1) for ahead, behind in (
                ([1, 2, 5, 6], [0, 3, 4, 7]), ([2, 3, 6, 7], [0, 1, 4, 5]), ([4, 5, 6, 7], [0, 1, 2, 3]))]
            at_centre = numpy.linalg.det(numpy.stack(axes, axis=1)) / 64
            self.assertGreater(at_centre.max() / at_centre.min(), 1.1)
            self.assertLess(abs(each.field("volume") / at_centre - 1).max(), 1e-9)
        with self.assertRaisesRegex(lacuna.Error, 'did you mean "skew"'):
            mesh.field("skevv")
        with self.assertRaisesRegex(lacuna.Error, "defined for hexahedra only"):
            mesh.field("skew", "wedge")
        self.assertEqual(mesh.field("volume", "tet").shape, (0,))

    def test_arrays_are_views_that_outlive_the_mesh(self):
        mesh = prism().sweep(layers=4, size=0.3)
        nodes, again, cells = mesh.coordinates(), mesh.coordinates(), mesh.cells("hex")
        self.assertEqual((nodes.shape, nodes.dtype), ((mesh.nodes, 3), numpy.float64))
        self.assertEqual((cells.shape, cells.dtype), ((mesh.hexes, 8), numpy.int32))
        self.assertTrue(numpy.shares_memory(nodes, again), "the memory is the mesh's own")
        self.assertFalse(nodes.flags.writeable)
        self.assertEqual(tuple(nodes[6]), mesh.node(7))
        self.assertEqual(tuple(cells[2]), mesh.hex(3))
        self.assertEqual((cells.min(), cells.max()), (1, mesh.nodes))
        kept = nodes.copy()
        del mesh, again
        gc.collect()
        for _ in range(20):
            prism().sweep(layers=4, size=0.3)
        self.assertTrue((nodes == kept).all())

    def test_faces_from_arrays(self):
        points = numpy.array([[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0]], dtype=float)
        model = lacuna.model()
        floor = model.add_face(points, numpy.array([[1, 4, 3, 2]]), name="floor")
        lid = model.add_face(points + [0, 0, 3], [[1, 2, 3], [1, 3, 4]], name="lid")
        self.assertEqual((floor.area, lid.area), (4, 4))
        void = model.open_volume(source=floor, target=lid)
        mesh = void.sweep(layers=numpy.int32(3), size=numpy.float32(0.5))
        self.assertEqual(mesh.hexes, 48)
        self.assertAlmostEqual(mesh.quality().volume, 12)
        with self.assertRaisesRegex(lacuna.Error, "found 0"):  # points count from 1
            model.add_face(points, [[0, 1, 2, 3]])

    def test_paths(self):
        mesh = prism().sweep(layers=2, size=0.5)
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "grün.msh"
            mesh.write(path, version=2.2, binary=False)
            self.assertEqual(lacuna.check(path).hexes, mesh.hexes)
            part = lacuna.load([path])
            mesh.write(str(path.with_suffix(".vtu")), with_=part)
            self.assertTrue(path.with_suffix(".vtu").exists())

    def test_what_is_not_installed_says_what_to_install(self):
        mesh = prism().sweep(layers=1, size=1)
        for package, call in ("pyvista", mesh.to_pyvista), ("meshio", mesh.to_meshio), ("dolfinx", mesh.to_dolfinx):
            with unittest.mock.patch.dict(sys.modules, {package: None}):
                with self.assertRaisesRegex(ImportError, f"{package} is not installed: .*python3-{package}"):
                    call()

    def test_notebooks_show_a_page_and_a_picture(self):
        void = prism()
        for shown in void.model(), void, void.sweep(layers=2, size=0.5):
            self.assertTrue(shown._repr_png_().startswith(b"\x89PNG"))
            self.assertTrue(shown._repr_html_().startswith("<iframe srcdoc="))


class Errors(unittest.TestCase):
    def test_an_error_has_code_entities_and_remedy(self):
        with self.assertRaises(lacuna.Error) as caught:
            lacuna.synthetic.prism().face(99)
        error = caught.exception
        self.assertEqual(error.code, "lua.bad_value")
        self.assertEqual((error.entities[0].kind, error.entities[0].tag), ("face", 99))
        self.assertTrue(str(error).endswith("[lua.bad_value]"))
        with self.assertRaises(lacuna.Error) as caught:
            lacuna.load("nowhere.step")
        self.assertEqual(caught.exception.code, "io.no_file")
        self.assertTrue(caught.exception.remedy)
        self.assertIn(caught.exception.remedy, caught.exception.message)
        again = pickle.loads(pickle.dumps(caught.exception))
        self.assertEqual((again.code, again.remedy), (caught.exception.code, caught.exception.remedy))

    def test_a_wrong_option_names_the_nearest(self):
        with self.assertRaisesRegex(lacuna.Error, "nearest is 'layers'"):
            prism().sweep(layer=3)
        with self.assertRaises(AttributeError):
            prism().sweeps

    def test_what_no_call_takes_is_a_type_error(self):
        for wrong in (lambda: prism().sweep(size=object()), lambda: prism().sweep("auto"),
                      lambda: lacuna.Mesh(), lambda: prism().sweep(layers=1, size=1).write()):
            with self.assertRaises(TypeError):
                wrong()

    def test_lists_hold_no_none_and_say_where(self):
        part = lacuna.synthetic.prism(sides=4)
        walls = [part.face(f"wall_{i}") for i in (1, 2, 3, 4)]
        points = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
        masked = numpy.ma.masked_array([0.5, 1], mask=[True, False])
        for where, wrong in {
                "walls[1]": lambda: part.open_volume(walls=[walls[0], None, *walls[1:]]),
                "cells[0][3]": lambda: lacuna.model().add_face(points, [[1, 2, 3, None]]),
                "[1]": lambda: lacuna.assembly([part.open_volume(), None]),
                "layers[0]": lambda: prism().sweep(layers=masked, size=0.5),
                "layers.count": lambda: prism().sweep(layers=dict(count=2**70)),
                "without[0]": lambda: lacuna.load("a.msh", without=[object()])}.items():
            with self.assertRaises(TypeError) as caught:
                wrong()
            self.assertTrue(str(caught.exception).startswith(where + ": "), caught.exception)
        for wrong in (lambda: lacuna.load("a.stl\0.step"), lambda: prism().sweep({None: 1}),
                      lambda: prism().sweep(layers=numpy.array([2**63], dtype=numpy.uint64)),
                      lambda: lacuna.load(sys.stdin)):
            with self.assertRaises(TypeError):
                wrong()

    def test_objects_are_neither_pickled_nor_copied(self):
        void = prism()
        self.assertIs(copy.copy(void), void)
        for wrong in copy.deepcopy, pickle.dumps:
            with self.assertRaisesRegex(TypeError, "write it to a file"):
                wrong(void)

    def test_an_error_leaves_all_usable(self):
        void = prism()
        for _ in range(3):
            with self.assertRaises(lacuna.Error):
                void.sweep(layers=0, size=0.5)
        self.assertEqual(void.sweep(layers=2, size=0.5).layers, 2)


class Callbacks(unittest.TestCase):
    def test_a_path_may_be_a_function_that_gives_arrays(self):
        model = lacuna.synthetic.prism()
        void = model.open_volume(source="source", along={"path": lambda t: numpy.array([0.0, 0, 2 * t])})
        self.assertEqual(void.class_, "0")

    def test_sizes_are_functions_of_the_place(self):
        places = []

        def size(x, y, z):
            places.append((x, y, z))
            return 0.25

        mesh = prism().sweep(layers=2, size=size)
        self.assertEqual(mesh.hexes, prism().sweep(layers=2, size=lambda x, y, z: 0.25).hexes)
        self.assertTrue(all(abs(x) <= 1.1 and abs(y) <= 1.1 for x, y, _ in places) and places)

    def test_what_a_callback_raises_comes_out(self):
        void = prism()
        with self.assertRaises(ZeroDivisionError):
            void.sweep(layers=2, size=lambda x, y, z: 1 / 0)
        with self.assertRaisesRegex(TypeError, "<lambda> has to return a number or a list of numbers, found None"):
            void.sweep(layers=2, size=lambda x, y, z: None)
        with self.assertRaises(TypeError):
            void.sweep(layers=2, size=lambda x: 1)
        self.assertEqual(void.sweep(layers=2, size=0.5).layers, 2)

    def test_a_callback_cannot_use_what_it_is_called_for(self):
        void = prism()
        with self.assertRaises(lacuna.Error) as caught:
            void.sweep(layers=2, size=lambda x, y, z: len(void.free_edges()))
        self.assertEqual(caught.exception.code, "lua.busy")

    def test_progress_is_told_on_the_calling_thread_and_may_stop(self):
        told = []

        def progress(stage, share):
            told.append((stage, share, threading.get_ident()))

        with lacuna.progress(progress):
            prism().sweep(layers=40, size=0.05)
        self.assertTrue(told)
        self.assertEqual({thread for _, _, thread in told}, {threading.get_ident()})
        told.clear()
        prism().sweep(layers=1, size=0.5)
        self.assertEqual(told, [])
        with lacuna.progress(lambda stage, share: False), self.assertRaises(lacuna.Error) as caught:
            prism().sweep(layers=40, size=0.05)
        self.assertEqual(caught.exception.code, "core.cancelled")
        with lacuna.progress(lambda stage, share: 1 / 0), self.assertRaises(ZeroDivisionError):
            prism().sweep(layers=40, size=0.05)
        self.assertEqual(prism().sweep(layers=1, size=0.5).layers, 1)

    def test_the_share_rises_from_0_to_1(self):
        part = lacuna.synthetic.prism(sides=6)
        void = part.open_volume()
        halves = lacuna.assembly(void.cut(plane=[(0, 0, 1), (0, 0, 1)]))
        with tempfile.TemporaryDirectory() as folder:
            for call in (lambda: void.sweep(layers=3, size=0.5), lambda: halves.sweep(layers=3, size=0.5),
                         lambda: void.sweep_to(f"{folder}/m.vtu", layers=3, size=0.5)):
                shares = []
                with lacuna.progress(lambda stage, share: shares.append(share)):
                    call()
                self.assertEqual(shares, sorted(shares))
                self.assertGreater(len(set(shares)), 5)
                self.assertEqual((shares[0], shares[-1]), (0, 1))

    def test_a_stop_that_comes_too_late_is_none(self):
        part = lacuna.synthetic.prism(sides=6, drop="walls")
        void = part.open_volume(source="source", target="target")
        told = []

        def late(stage, share):
            told.append(stage)
            time.sleep(0.2)  # the volume is closed meanwhile
            return numpy.False_

        with lacuna.progress(late):
            try:
                void.close()
            except lacuna.Error as error:
                self.assertEqual(error.code, "core.cancelled")
                self.assertFalse(void.is_watertight())
            else:
                self.assertTrue(void.is_watertight())
        self.assertEqual(len(told), 1)

    def test_progress_may_be_entered_twice(self):
        told = []
        progress = lacuna.progress(lambda stage, share: told.append(stage))
        with progress, progress:
            pass
        prism().sweep(layers=40, size=0.05)
        self.assertEqual(told, [])

    def test_a_size_function_sees_other_objects_and_waits_for_none(self):
        other = []
        thread = threading.Thread(target=lambda: other.append(prism()))
        thread.start()
        thread.join()
        self.assertEqual(prism().sweep(layers=2, size=lambda x, y, z: len(other[0].class_)).layers, 2)
        ready, codes = threading.Barrier(2), []
        voids = [None, None]

        def work(i):
            voids[i] = prism()

            ready.wait(10)
            first = threading.Event()

            def once(x, y, z):
                if not first.is_set():
                    first.set()
                    ready.wait(10)  # both calls run
                return 0.3 if voids[1 - i].class_ else 1

            try:
                voids[i].sweep(layers=2, size=once)
            except lacuna.Error as error:
                codes.append(error.code)

        threads = [threading.Thread(target=work, args=(i,), daemon=True) for i in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join(20)
            self.assertFalse(thread.is_alive())
        self.assertEqual(set(codes), {"lua.busy"})

    def test_notes_come_on_the_calling_thread(self):
        void, threads = prism(sides=24, bend=60), []
        handler = logging.Handler()
        handler.emit = lambda record: threads.append(threading.get_ident())
        logger = logging.getLogger("lacuna")
        logger.addHandler(handler)
        try:
            void.sweep(layers=6, size=0.4)
        finally:
            logger.removeHandler(handler)
        self.assertEqual(set(threads), {threading.get_ident()})

    def test_notes_are_warnings_of_logging(self):
        void = prism(sides=24, bend=60)
        with self.assertLogs("lacuna", "WARNING") as caught:
            void.sweep(layers=6, size=0.4)
        self.assertTrue(all("note: " in line for line in caught.output))


class Signals(unittest.TestCase):
    def test_no_call_takes_the_lock_of_all_loggers(self):
        """A signal that raises while it is taken would leave it held, and stop the notes of all threads."""
        void = prism(sides=24, bend=60)
        void.sweep(layers=6, size=0.4)
        with unittest.mock.patch("logging._acquireLock", create=True, side_effect=AssertionError):
            void.sweep(layers=6, size=0.4)

    def test_ctrl_c_stops_a_job_in_half_a_second(self):
        void = prism(sides=6, twist=40)
        sent = []

        def interrupt():
            sent.append(os.times().user)  # a virtual machine may take seconds to clear pages
            os.kill(os.getpid(), signal.SIGINT)

        for after in 0.05, 0.4:
            sent.clear()
            timer = threading.Timer(after, interrupt)
            timer.start()
            with self.assertRaises(KeyboardInterrupt):
                void.sweep(layers=400, size=0.005, threads=1)
            self.assertLess(os.times().user - sent[0], 0.5, "seconds of one processor")
            timer.join()
        self.assertEqual(void.sweep(layers=2, size=0.5).layers, 2)

    def test_ctrl_c_stops_a_size_function(self):
        sent = []

        def size(x, y, z):
            if not sent:
                sent.append(time.process_time())
                os.kill(os.getpid(), signal.SIGINT)
                time.sleep(0.05)  # the main thread takes it
            return 0.01

        with self.assertRaises(KeyboardInterrupt):
            prism().sweep(layers=2, size=size)
        self.assertLess(time.process_time() - sent[0], 0.5, "seconds of one processor")

    def test_what_any_handler_raises_stops_a_job(self):
        def late(*_):
            raise TimeoutError

        before = signal.signal(signal.SIGALRM, late)
        try:
            signal.setitimer(signal.ITIMER_REAL, 0.1)
            with self.assertRaises(TimeoutError):
                prism(sides=6).sweep(layers=400, size=0.005, threads=1)
        finally:
            signal.setitimer(signal.ITIMER_REAL, 0)
            signal.signal(signal.SIGALRM, before)
        self.assertEqual(prism().sweep(layers=2, size=0.5).layers, 2)

    def test_signals_in_look_ups_leave_nothing_held(self):
        face, random_numbers, stopped = prism().model().faces()[0], random.Random(1), 0
        area = face.area
        before = signal.signal(signal.SIGALRM, signal.default_int_handler)
        try:
            for _ in range(5000):
                try:
                    signal.setitimer(signal.ITIMER_REAL, random_numbers.uniform(1e-6, 1e-4))
                    while True:
                        self.assertEqual(face.area, area)
                except KeyboardInterrupt:
                    stopped += 1
        finally:
            signal.setitimer(signal.ITIMER_REAL, 0)
            signal.signal(signal.SIGALRM, before)
        self.assertEqual(stopped, 5000)

    def test_signals_at_any_time_leave_nothing_behind(self):
        def work():
            void = prism(sides=5)
            areas = [face.area for face in void.model().faces()]
            mesh = void.sweep(layers=8, size=lambda x, y, z: 0.25)
            return sum(areas), mesh.coordinates().tobytes(), mesh.quality().certified

        expected, random_numbers = work(), random.Random(1)
        stopped = 0
        before = signal.signal(signal.SIGALRM, signal.default_int_handler)
        try:
            for _ in range(60):
                try:
                    signal.setitimer(signal.ITIMER_REAL, random_numbers.uniform(0.0005, 0.05))
                    self.assertEqual(work(), expected)
                    signal.setitimer(signal.ITIMER_REAL, 0)
                except KeyboardInterrupt:
                    stopped += 1
        finally:
            signal.setitimer(signal.ITIMER_REAL, 0)
            signal.signal(signal.SIGALRM, before)
        self.assertGreater(stopped, 5)
        self.assertEqual(work(), expected)
        gc.collect()
        self.assertEqual(objects_left(), 0)


class Threads(unittest.TestCase):
    def run_both(self, body):
        failed = []

        def guarded(i):
            try:
                body(i)
            except BaseException as error:
                failed.append(error)

        threads = [threading.Thread(target=guarded, args=(i,)) for i in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        if failed:
            raise failed[0]

    def test_two_threads_have_an_interpreter_each(self):
        def nodes(i):
            mesh = prism(sides=5 + i).sweep(layers=3, size=lambda x, y, z: 0.3)
            return mesh.coordinates().tobytes()

        made = [None, None]

        def body(i):
            for _ in range(5):
                made[i] = nodes(i)

        self.run_both(body)
        self.assertEqual(made, [nodes(0), nodes(1)])

    def test_objects_go_from_thread_to_thread_one_call_at_a_time(self):
        void = prism()
        counts = [0, 0]

        def body(i):
            for _ in range(10):
                counts[i] += void.sweep(layers=1, size=0.5).layers

        self.run_both(body)
        self.assertEqual(counts, [10, 10])

    def test_one_call_takes_objects_of_one_thread(self):
        others = []
        thread = threading.Thread(target=lambda: others.append(prism()))
        thread.start()
        thread.join()
        with self.assertRaisesRegex(ValueError, "different threads"):
            lacuna.assembly([prism(), others[0]])
        self.assertEqual(others[0].class_, "I")

    def test_a_thread_may_end_while_its_objects_are_released(self):
        def work():
            part = lacuna.synthetic.prism(sides=20)
            return [part.faces() for _ in range(10)] and None

        for _ in range(40):
            thread = threading.Thread(target=work)
            thread.start()
            thread.join()

    def test_python_ends_while_a_daemon_thread_meshes(self):
        code = ("import lacuna, threading, time, atexit\n"
                "atexit.register(lambda: print(void.sweep(layers=1, size=0.5).layers))\n"
                "void = lacuna.synthetic.prism(sides=4).open_volume()\n"
                "def work():\n    while True: void.sweep(layers=40, size=lambda x, y, z: 0.1)\n"
                "threading.Thread(target=work, daemon=True).start()\ntime.sleep(0.2)\n")
        for _ in range(2):
            done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stderr, done.stdout), (0, "", "1\n"))

    def test_another_thread_runs_while_a_job_runs(self):
        turns, done = [], threading.Event()

        def count():
            while not done.is_set():
                turns.append(time.perf_counter())
                time.sleep(0.001)

        thread = threading.Thread(target=count)
        thread.start()
        prism().sweep(layers=60, size=0.02, threads=1)
        done.set()
        thread.join()
        self.assertGreater(len(turns), 20, "the job held the lock of the interpreter")

    def test_a_forked_process_has_an_interpreter_of_its_own(self):
        void = prism()
        mesh = void.sweep(layers=1, size=0.5)
        before = objects_left()
        child = os.fork()
        if child == 0:
            try:
                counts = [each.sweep(layers=2, size=0.5).layers for each in (void, prism())]
                del mesh
                void.free_edges()  # what was dropped is released before it
                os._exit(0 if (counts, objects_left()) == ([2, 2], before - 1) else 1)
            finally:
                os._exit(1)
        self.assertEqual(os.waitpid(child, 0)[1], 0)

    def test_a_process_may_be_forked_while_objects_are_released(self):
        void = prism()
        for _ in range(20):
            dropped = prism()
            del dropped
            until = time.perf_counter() + 0.001
            while time.perf_counter() < until:
                pass  # the thread that releases it is woken, and waits for this one
            child = os.fork()
            if child == 0:
                signal.alarm(10)
                for _ in range(2):
                    void.sweep(layers=1, size=0.5)
                    time.sleep(0.01)  # its own thread waits for the next call
                os._exit(0)
            self.assertEqual(os.waitpid(child, 0)[1], 0)


class Memory(unittest.TestCase):
    def test_a_thousand_models_leave_nothing(self):
        def models(count):
            for i in range(count):
                part = lacuna.synthetic.prism(sides=3, facets=1, drop="walls")
                void = part.open_volume(source=part.faces()[0], target="target")
                if i % 20 == 0:
                    mesh = void.sweep(layers=2, size=0.5)
                    self.assertEqual(len(mesh.coordinates()), mesh.nodes)
                    mesh.quality().metrics

        models(100)
        before = resident()
        models(1000)
        self.assertLess(resident() - before, 2 << 20)

    def test_a_mesh_is_freed_when_it_is_dropped(self):
        void = prism()
        mesh = void.sweep(layers=100, size=0.02)
        quality, cells = mesh.quality(), mesh.cells()
        held = resident()
        size = mesh.nodes * 24 + cells.nbytes
        del mesh, quality, cells
        void.free_edges()  # calls come after what was dropped before them
        self.assertLess(resident(), held - size / 2)

    def test_failed_and_stopped_calls_leave_nothing(self):
        void = prism()
        gc.disable()
        self.addCleanup(gc.enable)
        with lacuna.progress(lambda stage, share: False):
            for _ in range(3):
                with self.assertRaises(lacuna.Error):
                    void.sweep(layers=40, size=0.05)
        for wrong in dict(layers=0), dict(size=lambda x, y, z: 1 / 0):
            with self.assertRaises((lacuna.Error, ZeroDivisionError)):
                void.sweep(**wrong)
        self.assertEqual(void.sweep(layers=1, size=0.5).layers, 1)
        gone = weakref.ref(void)
        del void
        self.assertIsNone(gone())


if __name__ == "__main__":
    unittest.main()
