# SPDX-License-Identifier: MIT
# Made by python/generate.py from lua/lacuna.d.lua.
"""Classes and functions, as lacuna.d.lua has them."""
from ._objects import (AnyFace, AnyMesh, Object, Shown, Table, call, classes, loaded,
                       options_of, shaped)

__all__ = [
        "Contact", "ModelInfo", "FaceInfo", "Cavity", "Classification", "Match", "Closure", "FreeEdge",
        "LeftOut", "Fidelity", "FaceFidelity", "AssemblyFidelity", "WorstCell", "MetricSummary", "Model",
        "Face", "Volume", "Mesh", "Assembly", "AssemblyMesh", "QuadMesh", "Quality", "load", "model",
        "assembly", "split_interface", "check", "convert", "view",
]


class Contact(Table):
    """Two bodies whose faces touch or face each other.

    a: str; region
    b: str; region
    name: str; of the pair; default: a_b
    type: "tie" | "contact"; default "tie"
    gap: float; within which the faces are looked for [model length]
    faces: list[list[int]]; tags of the faces that come together
    least: float; smallest distance within the gap [model length]
    width: float; largest distance within the gap [model length]
    area: float; of the faces of `a` within the gap [model length²]
    slave: str; group of a mesh
    master: str; group of a mesh
    """

    __slots__ = ()
    _shapes = {}
    _optional = ['name', 'type', 'gap', 'faces', 'least', 'width', 'area', 'slave', 'master']


class ModelInfo(Table):
    """source: str
    diagonal: float; [model length]
    tolerance: float; [model length]
    parts: int; sets of faces that hang together
    closed_parts: int; those without free edges
    faces: list[FaceInfo]
    free_edges: list[Table]
    gaps: list[Table]; with the tolerance that sews each
    cavities: list[Cavity]
    """

    __slots__ = ()
    _shapes = {'faces': ('list', ('of', 'FaceInfo')), 'cavities': ('list', ('of', 'Cavity'))}
    _optional = []


class FaceInfo(Table):
    """tag: int; the one Gmsh shows for the same file
    name: str
    kind: str
    area: float; [model length²]
    normal: list[float]; mean unit normal; zero all round a tube
    centroid: list[float]
    loops: int
    edges: int
    has_mesh: bool
    radius: float; of the cylinder or sphere that its facets lie on [model length]
    axis: list[float]; of that cylinder
    box: list[list[float]]; its lowest and highest coordinates
    neighbours: list[int]; tags of faces that share an edge with it
    fits: "cylinder" | "sphere" | "cone"; what its facets lie on
    centre: list[float]; of that cylinder or sphere
    apex: list[float]; tip of that cone, whose axis leads from it
    half_angle: float; between axis and surface of that cone [degrees]
    least_radius: float; of the face on that cone [model length]
    largest_radius: float; of the face on that cone [model length]
    free_edges: int; how many
    part: int; of the sets of faces that hang together
    cavity: int; a number in `cavities`
    use: str; a kind of cavity, "outer skin" or "open shell"
    """

    __slots__ = ()
    _shapes = {}
    _optional = ['radius', 'axis', 'fits', 'centre', 'apex', 'half_angle', 'least_radius', 'largest_radius',
                 'cavity']


class Cavity(Table):
    """kind: "pocket" | "bore" | "slot" | "inner void"
    faces: list[int]; tags, for open_volume(faces=…)
    class_: "I" | "II" | "III" | "IV" | "V" | "closed" | "0"
    volume: float; once it is sealed [model length³]
    """

    __slots__ = ()
    _shapes = {}
    _optional = []


class Classification(Table):
    """class_: "I" | "II" | "III" | "IV" | "V" | "closed" | "0"
    free_loops: int
    wall_free_source: list[int]; tags of vertices on no wall
    wall_free_target: list[int]
    reasons: list[str]
    """

    __slots__ = ()
    _shapes = {}
    _optional = []


class Match(Table):
    """loops: list[Table]
    vertices: list[list[int]]; tags: source, target
    method: str
    confidence: float; 0 to 1
    notes: list[str]
    """

    __slots__ = ()
    _shapes = {}
    _optional = []


class Closure(Table):
    """void_edges: int; how many were made
    void_faces: int
    void_edge_tags: list[int]
    void_face_tags: list[int]
    watertight: bool
    algorithms: list[str]; of the paper, in the order used
    """

    __slots__ = ()
    _shapes = {}
    _optional = []


class FreeEdge(Table):
    """tag: int
    from_: int; tag of a vertex
    to: int
    length: float; [model length]
    """

    __slots__ = ()
    _shapes = {}
    _optional = []


class LeftOut(Table):
    """region: str
    code: str; the error's
    message: str
    """

    __slots__ = ()
    _shapes = {}
    _optional = []


class Fidelity(Table):
    """The mesh's skin against the sealed skin.

    volume: float; of the cells [model length³]
    sealed_volume: float; [model length³]
    max_distance: float; [model length]
    mean_distance: float; [model length]
    faces: dict[int | str, FaceFidelity]; by tag, void faces by "void:<n>"
    """

    __slots__ = ()
    _shapes = {'faces': ('map', ('of', 'FaceFidelity'))}
    _optional = []


class FaceFidelity(Table):
    """quads: int; of the skin that lie on it
    max_distance: float; [model length]; of a face without quads its width
    mean_distance: float; [model length]
    place: list[float]; where skin and face are furthest apart
    """

    __slots__ = ()
    _shapes = {}
    _optional = []


class AssemblyFidelity(Table):
    """Sums over the volumes of an assembly, and each volume's.

    volume: float; of the cells [model length³]
    sealed_volume: float; [model length³]
    max_distance: float; [model length]
    mean_distance: float; [model length]
    regions: dict[str, Fidelity]
    """

    __slots__ = ()
    _shapes = {'regions': ('map', ('of', 'Fidelity'))}
    _optional = []


class WorstCell(Table):
    """cell: int
    layer: int
    centre: list[float]
    scaled_jacobian: float
    """

    __slots__ = ()
    _shapes = {}
    _optional = ['layer']


class MetricSummary(Table):
    """name: str
    cells: int; cells for which it is defined
    min: float
    mean: float
    max: float
    deviation: float
    acceptable: list[float]; after Cubit; None where it depends on the job
    outside: int; cells outside the acceptable range
    outside_share: float; of all cells, 0 to 1
    worst: Table
    """

    __slots__ = ()
    _shapes = {}
    _optional = ['acceptable']


class Model(Shown):
    __slots__ = ()
    _at_once = False

    @property
    def tolerance(self):
        """[model length]"""
        return self._field("tolerance")

    @property
    def diagonal(self):
        """[model length]"""
        return self._field("diagonal")

    def faces(self, selector=None, /, **keywords):
        """The faces that fit all that is named; without a selector all of them.

        tags: int | list[int]
        name: str; a physical group, a part (`pid:7`), an element set
        kind: "plane" | "cylinder" | "cone" | "sphere" | "torus" | "bspline" | "surface" | "discrete"
        facing: (x, y, z); the mean normal within 30 degrees of it
        normal_within: float; instead of the 30 degrees of `facing`
        near: (x, y, z); the one closest face
        within: float; all faces that close to `near` instead [model length]
        box: list[(x, y, z)]; two corners of a box that all of the face lies in
        touching: Face | int | str; a face it shares an edge with
        region: str; the solid, part or set it bounds
        free: bool; whether it bounds one region alone
        radius: list[float]; smallest and largest, of parts of cylinders and spheres [model length]
        area: list[float]; smallest and largest [model length²]
        """
        return self._method("faces", options_of(selector, keywords))

    def face(self, which=None, /, **keywords):
        """Exactly one; none or several is an error that lists the candidates.

        tags: int | list[int]
        name: str; a physical group, a part (`pid:7`), an element set
        kind: "plane" | "cylinder" | "cone" | "sphere" | "torus" | "bspline" | "surface" | "discrete"
        facing: (x, y, z); the mean normal within 30 degrees of it
        normal_within: float; instead of the 30 degrees of `facing`
        near: (x, y, z); the one closest face
        within: float; all faces that close to `near` instead [model length]
        box: list[(x, y, z)]; two corners of a box that all of the face lies in
        touching: Face | int | str; a face it shares an edge with
        region: str; the solid, part or set it bounds
        free: bool; whether it bounds one region alone
        radius: list[float]; smallest and largest, of parts of cylinders and spheres [model length]
        area: list[float]; smallest and largest [model length²]
        """
        return self._method("face", options_of(which, keywords) if keywords else which)

    def face_from(self, near, **keywords):
        """A face grown from the facet closest to a place, taken out of the faces it goes over.

        near: (x, y, z); the facet closest to it is where the face begins [model length]
        angle: float; the face goes on over sides that turn by no more [degrees]; default 20
        region: str; only over faces that bound it
        free: bool; only over faces that bound one region alone, or two
        """
        return self._method("face_from", options_of(None, keywords, near=near))

    def add_face(self, points, cells, **keywords):
        """Add a face of triangles and quads to the model. Points count from 1.

        name: str
        points: list[(x, y, z)] | numpy.ndarray
        cells: list[list[int]] | numpy.ndarray; triangles and quads: numbers of points from 1
        keep_mesh: bool; quads are a mesh to be kept, not mere facets; default False
        """
        return self._method("add_face", options_of(None, keywords, points=points, cells=cells))

    def open_volume(self, roles=None, /, **keywords):
        """The volume that faces bound, with the roles that are named. Without roles they are found, for
        `faces` or all faces.

        source: Face | int | str | dict | list[Face | int | str | dict]
        target: Face | int | str | dict | list[Face | int | str | dict]
        walls: Face | int | str | dict | list[Face | int | str | dict] | "auto"; "auto": the source's cavity
            in a solid, else all that hangs on its rim
        faces: Face | int | str | dict | list[Face | int | str | dict]; instead of roles: these faces make the
            volume, and their roles are found
        reading: int; with roles to be found: which of the voids that were found, from 1
        full_turn: bool; the walls are a ring, swept round its whole turn; no ends; default False
        along: dict; with a source, and given walls if any: the path along which it is swept
        fill_to: list[(x, y, z)]; point and normal: only the part of the void behind this plane
        class_: "I" | "II" | "III" | "IV" | "V" | "closed" | "0"; override
        name: str; what the cells are called: their group, set or property in files; default "volume"
        material: str | int; of the cells, in decks; default: as the elements beside them
        glued: bool; False: in an assembly it has nodes of its own, and ties to what it touches; default True

        A dict for `along` has:
        vector: (x, y, z); straight
        axis: list[(x, y, z)]; point and direction, turned round by `angle`
        angle: float; of a turn round `axis`, up to 360 either way [degrees]
        path: list[(x, y, z)] | numpy.ndarray | list[int] | Callable[[float], (x, y, z)]; points with corners,
            tags of edges, or a smooth curve for t from 0 to 1
        frame: "minimal" | "fixed"; with `path`: whether the source turns with it; default "minimal"
        helix: list[(x, y, z) | float]; point, direction, pitch and turns; negative turns: left-handed
        normals: float | Callable[[float, float, float], float] | list[float | Callable[[float, float, float],
            float]]; thickness along the source's normals, or [inside, outside]
        to: Face | int | str | dict; along the source's mean normal onto this face
        twist: float | Callable[[float], float]; of the target, or at heights from 0 to 1 [degrees]
        scale: float | Callable[[float], float]; of the target, or at heights from 0 to 1
        """
        return self._method("open_volume", options_of(roles, keywords))

    def quads(self, options=None, /, **keywords):
        """Quads on faces, without layers.

        faces: Face | int | str | dict | list[Face | int | str | dict]; default: all
        size: float | Callable[[float, float, float], float]; edge length; default: the rims' spacing
        curvature: int; sides for a full turn where the size is coarser; default 12; 0: the size alone
        gap: int; quads asked for across a narrow place; default: none, 3 where there is no size
        quads: "auto" | "paved" | "mapped" | "gmsh" | "keep"; default "auto"; the report says which way each
            face was meshed
        order: 1 | 2; quads of 4, or of 9 nodes with middle nodes on curves and surfaces; default 1
        serendipity: bool; with order 2: quads of 8 nodes; default False
        threads: int; default: all cores
        """
        return self._method("quads", options_of(options, keywords))

    def contacts(self, options=None, /, **keywords):
        """Bodies whose faces touch or face each other.

        gap: float; largest distance of the faces; default 0: they touch [model length]
        """
        return shaped(self._method("contacts", options_of(options, keywords)), ('list', ('of', 'Contact')))

    def describe(self):
        """Faces, free edges, gaps and cavities, in words."""
        return self._method("describe")

    def info(self):
        """The same as a table."""
        return shaped(self._method("info"), ('of', 'ModelInfo'))

    def cavities(self):
        """Pockets, bores and inner voids of closed skins."""
        return shaped(self._method("cavities"), ('list', ('of', 'Cavity')))

    def view(self, path, options=None, /, **keywords):
        """A page for a browser: the faces, labelled, to be clicked for the roles of a recipe.

        path: .html
        title: str; default: what the input is called
        """
        self._method("view", path, options_of(options, keywords))

    def picture(self, path, options=None, /, **keywords):
        """Drawn without a display: the faces, and their free edges.

        path: .png
        width: int; default 1200 [pixels]
        height: int; default 900 [pixels]
        facets: bool; sides of the facets are drawn; default False
        legend: bool; a title, and what the colours mean; default True
        title: str; default what is shown, counted
        view: (x, y, z) | "iso" | "front" | "back" | "left" | "right" | "top" | "bottom"; from what is seen to
            the eye; default "iso"
        """
        self._method("picture", path, options_of(options, keywords))


class Face(AnyFace):
    __slots__ = ()

    @property
    def tag(self):
        """the one Gmsh shows for the same file"""
        return self._field("tag")

    @property
    def name(self):
        return self._field("name")

    @property
    def kind(self):
        return self._field("kind")

    @property
    def area(self):
        """[model length²]"""
        return self._field("area")

    @property
    def normal(self):
        """mean unit normal; zero all round a tube"""
        return self._field("normal")

    @property
    def centroid(self):
        return self._field("centroid")

    @property
    def loops(self):
        return self._field("loops")

    @property
    def edges(self):
        return self._field("edges")

    @property
    def has_mesh(self):
        return self._field("has_mesh")

    @property
    def radius(self):
        """of the cylinder or sphere that its facets lie on [model length]"""
        return self._field("radius")

    @property
    def axis(self):
        """of that cylinder"""
        return self._field("axis")

    @property
    def box(self):
        """its lowest and highest coordinates"""
        return self._field("box")

    @property
    def neighbours(self):
        """tags of faces that share an edge with it"""
        return self._field("neighbours")


class Volume(Shown):
    __slots__ = ()

    @property
    def class_(self):
        """as the volume was given"""
        return self._field("class")

    def classify(self):
        """Which faces are missing, and why the volume is of its class."""
        return shaped(self._method("classify"), ('of', 'Classification'))

    def override_class(self, class_):
        """Take the volume as one of another class; what contradicts it is an error."""
        return self._method("override_class", class_)

    def match(self, options=None, /, **keywords):
        """Pair the loops and vertices of source and target; `close` does it where this was not called.

        vertices: list[list[int]] | numpy.ndarray; tags: source, target
        loops: list[list[int]] | numpy.ndarray; numbers: source, target
        flip: list[int]; source loops whose direction on the target is turned round
        method: "aligned" | "nearest"; default "aligned"
        """
        return shaped(self._method("match", options_of(options, keywords)), ('of', 'Match'))

    def close(self, options=None, /, **keywords):
        """Make the edges and faces that are missing. The volume is sealed afterwards; `sweep` does it where
        this was not called.

        edge_shape: "auto" | "straight" | "follow" | "smooth"; how a void edge runs; default "auto"
        void_edges: list[list[int | list[(x, y, z)] | numpy.ndarray]]; given by hand: vertex tags from and to,
            points between
        cap: "auto" | "flat" | "parallel"; shape of a missing end; default "auto"
        holes: "cover" | "through"; holes of a given end that have no walls; without it an error where the
            other end is missing
        """
        return shaped(self._method("close", options_of(options, keywords)), ('of', 'Closure'))

    def is_watertight(self):
        """Whether nothing is missing."""
        return self._method("is_watertight")

    def free_edges(self):
        """Edges that have a missing face beside them."""
        return shaped(self._method("free_edges"), ('list', ('of', 'FreeEdge')))

    def tree(self):
        """Volume, faces, edges and vertices as text, with the geometry of each; void ones are marked."""
        return self._method("tree")

    def describe(self):
        """Roles, class, what is missing and what was paired, as text."""
        return self._method("describe")

    def view(self, path, options=None, /, **keywords):
        """A page for a browser: roles, void faces, free edges and vertices on no wall.

        path: .html
        title: str; default: what the input is called
        """
        self._method("view", path, options_of(options, keywords))

    def picture(self, path, options=None, /, **keywords):
        """Drawn without a display: given faces, and those that were made.

        path: .png
        width: int; default 1200 [pixels]
        height: int; default 900 [pixels]
        facets: bool; sides of the facets are drawn; default False
        legend: bool; a title, and what the colours mean; default True
        title: str; default what is shown, counted
        view: (x, y, z) | "iso" | "front" | "back" | "left" | "right" | "top" | "bottom"; from what is seen to
            the eye; default "iso"
        """
        self._method("picture", path, options_of(options, keywords))

    def cut(self, options=None, /, **keywords):
        """By a plane or a face: the pieces, which share what was cut. Without options: the pieces of a volume
        with branches, or one of whose ends lies at several heights; itself where it has neither.

        plane: list[(x, y, z)]; point and normal
        face: Face | int | str | dict; a Face of any model, or one of the volume's own
        auto: bool; where pieces result that can be swept: planes beside concave edges, or blocks at the
            vertices
        """
        return self._method("cut", options_of(options, keywords))

    def model(self):
        """The volume's faces, void ones included."""
        return self._method("model")

    def sweep(self, options=None, /, **keywords):
        """Closes first where the recipe did not. A volume with steps is cut into pieces and meshed as an
        assembly.

        layers: int | list[float] | dict; a count, rising heights in (0, 1] or a spacing; default as the
            walls' own meshes have rows, else about as high as the quads are wide
        size: float | Callable[[float, float, float], float]; edge length on the source; default: the rim's
            spacing
        curvature: int; sides for a full turn where the size is coarser; default 12; 0: the size alone
        gap: int; quads asked for across a narrow place of the source; default: none, 3 where there is no size
        max_deviation: float; how far the skin may be from the sealed skin [model length]; default: a quarter
            of a quad's side
        quads: "auto" | "paved" | "mapped" | "gmsh" | "keep"; default "auto"; the report says which way each
            face was meshed
        fallback: "wedges" | "leave_out" | "mixed"; what becomes of a volume that cannot be hexahedra alone;
            default: an error
        wedges: bool; triangles that an end came with stay, with wedges on them; default False: quads among
            triangles are an error
        rows: int; rows of quads from every loop of the source that stay as they are laid; default: what the
            paver finds good
        row_height: float | Callable[[float, float, float], float]; of those rows (one at least); default: the
            size
        boundary_layers: dict | list[dict]; thin rows of cells along walls and ends
        intervals: list[list[Any]]; numbers of sides on edges, walls and along the sweep
        periodic: list[list[Any]]; faces with the same mesh under a translation or rotation
        order: 1 | 2; of the cells: hex8, or hex27 with middle nodes on curves and surfaces; default 1
        serendipity: bool; with order 2: hex20 instead of hex27; default False
        min_scaled_jacobian: float; below it the mesh is refused; default 0
        improve: bool | dict; default True; iterations of each descent, 60
        interior: "auto" | "affine" | "residual" | "normals"; how layers are placed; all but "auto" for
            comparison
        threads: int; default: all cores

        A dict for `layers` has:
        count: int
        bias: float; last over first layer height (geometric), middle over end (bell), end over middle
            (both_ends)
        mode: "geometric" | "bell" | "both_ends"; default "geometric"

        A dict for `boundary_layers` has:
        walls: Face | int | str | dict | list[Face | int | str | dict]; walls and ends; "walls": all walls,
            "void:<n>": a void face
        first: float; thickness of the cells at the face, square to it [model length]
        growth: float; thickness of each row over the one before; default 1
        count: int; rows; default 1

        One of `intervals`: What, how many sides, and the last length over the first (default 1). What: an
        edge's tag, the tags of two vertices, a wall by Face, name or selector, or "sweep" for the layers.

        A dict for `periodic` has:
        [1]: Face | int | str | dict | list[Face | int | str | dict]
        [2]: Face | int | str | dict | list[Face | int | str | dict]
        translate: (x, y, z)
        rotate: list[(x, y, z) | float]; point, direction, degrees
        """
        return self._method("sweep", options_of(options, keywords))

    def sweep_to(self, path, options=None, /, **keywords):
        """Sweep and write a layer at a time, in memory that the number of layers hardly matters to: the bytes
        of sweep(...).write(path). The report has nodes, hexes, wedges, layers, min_scaled_jacobian, streamed,
        processes (with mpirun) and seconds by stage.

        path: .msh, .vtu, .pvtu, .vtk, .inp, .bdf, .nas, .dat, .unv, .exo, .e, .k or .feb
        layers: int | list[float] | dict; a count, rising heights in (0, 1] or a spacing; default as the
            walls' own meshes have rows, else about as high as the quads are wide
        size: float | Callable[[float, float, float], float]; edge length on the source; default: the rim's
            spacing
        curvature: int; sides for a full turn where the size is coarser; default 12; 0: the size alone
        gap: int; quads asked for across a narrow place of the source; default: none, 3 where there is no size
        max_deviation: float; how far the skin may be from the sealed skin [model length]; default: a quarter
            of a quad's side
        quads: "auto" | "paved" | "mapped" | "gmsh" | "keep"; default "auto"; the report says which way each
            face was meshed
        fallback: "wedges" | "leave_out" | "mixed"; what becomes of a volume that cannot be hexahedra alone;
            default: an error
        wedges: bool; triangles that an end came with stay, with wedges on them; default False: quads among
            triangles are an error
        rows: int; rows of quads from every loop of the source that stay as they are laid; default: what the
            paver finds good
        row_height: float | Callable[[float, float, float], float]; of those rows (one at least); default: the
            size
        boundary_layers: dict | list[dict]; thin rows of cells along walls and ends
        intervals: list[list[Any]]; numbers of sides on edges, walls and along the sweep
        periodic: list[list[Any]]; faces with the same mesh under a translation or rotation
        order: 1 | 2; of the cells: hex8, or hex27 with middle nodes on curves and surfaces; default 1
        serendipity: bool; with order 2: hex20 instead of hex27; default False
        min_scaled_jacobian: float; below it the mesh is refused; default 0
        improve: bool | dict; default True; iterations of each descent, 60
        interior: "auto" | "affine" | "residual" | "normals"; how layers are placed; all but "auto" for
            comparison
        threads: int; default: all cores
        write: dict; how the file is written; default as mesh.write

        A dict for `layers` has:
        count: int
        bias: float; last over first layer height (geometric), middle over end (bell), end over middle
            (both_ends)
        mode: "geometric" | "bell" | "both_ends"; default "geometric"

        A dict for `boundary_layers` has:
        walls: Face | int | str | dict | list[Face | int | str | dict]; walls and ends; "walls": all walls,
            "void:<n>": a void face
        first: float; thickness of the cells at the face, square to it [model length]
        growth: float; thickness of each row over the one before; default 1
        count: int; rows; default 1

        One of `intervals`: What, how many sides, and the last length over the first (default 1). What: an
        edge's tag, the tags of two vertices, a wall by Face, name or selector, or "sweep" for the layers.

        A dict for `periodic` has:
        [1]: Face | int | str | dict | list[Face | int | str | dict]
        [2]: Face | int | str | dict | list[Face | int | str | dict]
        translate: (x, y, z)
        rotate: list[(x, y, z) | float]; point, direction, degrees
        """
        return self._method("sweep_to", path, options_of(options, keywords))

    def write_facets(self, path, options=None, /, **keywords):
        """The facets of the sealed volume, watertight and outward.

        path: .stl, .msh or .obj
        binary: bool
        groups: "one" | "all"
        """
        self._method("write_facets", path, options_of(options, keywords))

    def write_cad(self, path, options=None, /, **keywords):
        """The sealed volume as one CAD solid: given CAD faces exact, void faces as planes or fitted surfaces.

        path: .step, .stp or .brep
        tolerance: float
        deviation: float
        cad_seconds: float
        cad_megabytes: float
        """
        return self._method("write_cad", path, options_of(options, keywords))


class Mesh(AnyMesh):
    __slots__ = ()

    @property
    def left_out(self):
        """none"""
        return shaped(self._field("left_out"), ('list', ('of', 'LeftOut')))

    @property
    def fidelity(self):
        return shaped(self._field("fidelity"), ('of', 'Fidelity'))

    @property
    def nodes(self):
        return self._field("nodes")

    @property
    def hexes(self):
        return self._field("hexes")

    @property
    def wedges(self):
        return self._field("wedges")

    @property
    def pyramids(self):
        return self._field("pyramids")

    @property
    def tets(self):
        return self._field("tets")

    @property
    def layers(self):
        return self._field("layers")

    @property
    def order(self):
        return self._field("order")

    @property
    def regions(self):
        """the one volume's name"""
        return self._field("regions")

    @property
    def report(self):
        return self._field("report")

    def quality(self):
        """Scaled Jacobian, certificate, volume and other metrics of the cells."""
        return self._method("quality")

    def groups(self):
        """Groups of quads and cells, as files have them."""
        return self._method("groups")

    def copy(self, options=None, /, **keywords):
        """A copy, moved as a whole; a mirrored one is turned over, so that its cells stay positive.

        translate: (x, y, z)
        rotate: list[(x, y, z) | float]; point, direction and angle [degrees]
        mirror: list[(x, y, z)]; point and normal of the plane
        name: str; region of the copy; of several regions the start of their names; default: as the mesh
        """
        return self._method("copy", options_of(options, keywords))

    def pattern(self, count, **keywords):
        """The mesh and copies of it, each moved against the one before, as one mesh.

        translate: (x, y, z); from each copy to the next
        rotate: list[(x, y, z) | float]; point, direction and angle [degrees]
        count: int; copies, the mesh itself included
        numbered: bool; regions are name_1, name_2 and so on; default False: copies are one region
        """
        return self._method("pattern", options_of(None, keywords, count=count))

    def node(self, i):
        """Coordinates of a node."""
        return self._method("node", i)

    def wedge(self, i):
        """Six node numbers, Gmsh order."""
        return self._method("wedge", i)

    def hex(self, i):
        """Eight node numbers, Gmsh order."""
        return self._method("hex", i)

    def coordinates(self):
        """Of every node x, y, z, as they lie in memory."""
        return self._array("coordinates")

    def cells(self, kind=None):
        """Of every cell the numbers of its nodes, from 1; of order 2 the middle nodes too, in VTK's order.

        kind: default "hex"
        """
        return self._array("cells", kind)

    def field(self, metric=None, kind=None):
        """A metric of every cell of a kind, in the order of `cells(kind)`.

        metric: default "scaled_jacobian"; of cells that are no hexahedra also "jacobian" and "volume"
        kind: default "hex"
        """
        return self._array("field", metric, kind)

    def write(self, path, options=None, /, **keywords):
        """A file in the format of its ending.

        path: .msh, .vtu, .pvtu, .vtk, .inp, .bdf, .nas, .dat, .unv, .exo, .e, .k, .feb, .med, or a folder
            called polyMesh
        version: float
        binary: bool
        quality: bool | str | list[str]; metrics that go along for every cell, as $ElementData or cell arrays;
            True: the scaled Jacobian; default True, but False for version 2.2
        with_: Model | list[Model]; loaded from finite element meshes, that the mesh is joined to; the
            volume's first
        without: str | int | list[str | int]; regions, properties, sets or parts of these models that are left
            out
        renumber: bool; numbers and names that several decks have in common become others; default False
        first_node: int; of decks and with a model; default above all that are taken
        first_cell: int; likewise
        element: str; Abaqus's word for the hexahedra of .inp; default "C3D8", of order 2 "C3D20"; thin
            layers: "COH3D8", "GK3D8", "SC8R", "CSS8"
        groups: "one" | "all"; of .msh: whether cells are in one physical group or in all of theirs, which
            overlap; default "one"
        gmsh_options: bool; of .msh: a file beside it, .opt behind its name, with which Gmsh shows cells and
            groups; default False
        interfaces: bool; of an assembly: quads between its volumes are elements too; default False
        orientation: bool; directions of cells: fields in .vtu, .vtk and .exo, material axes in .inp and .bdf;
            default False
        partitions: int | "processes"; of .pvtu and .msh: parts; of .pvtu default as many as processes
        ghosts: int; rows of other parts' cells that are marked as each part's ghosts; default 0
        """
        self._method("write", path, options_of(options, keywords))

    def view(self, path, options=None, /, **keywords):
        """A page for a browser: the mesh, to be turned, cut and coloured.

        path: .html
        title: str; default: what the input is called
        """
        self._method("view", path, options_of(options, keywords))

    def picture(self, path, options=None, /, **keywords):
        """Drawn without a display.

        path: .png
        width: int; default 1200 [pixels]
        height: int; default 900 [pixels]
        view: (x, y, z) | "iso" | "front" | "back" | "left" | "right" | "top" | "bottom"; from what is seen to
            the eye; default "iso"
        colour: "quality" | "layer" | "groups" | "region" | "origin"; default "quality"
        cut: dict; cells whose centre lies behind the plane are shown whole
        layers: list[int]; first and last that is shown; default all
        edges: bool; sides of cells; default True
        legend: bool; a title, and what the colours mean; default True
        title: str; default the name of the mesh and its counts
        """
        self._method("picture", path, options_of(options, keywords))


class Assembly(Object):
    """Several volumes to be meshed as one."""

    __slots__ = ()

    def contacts(self, options=None, /, **keywords):
        """Volumes whose faces touch or face each other without common nodes.

        gap: float; largest distance of the faces; default 0: they touch [model length]
        """
        return shaped(self._method("contacts", options_of(options, keywords)), ('list', ('of', 'Contact')))

    def sweep(self, options=None, /, **keywords):
        """Options for all volumes; a dict `{volume: options}` before them lays those of one over them.

        layers: int | list[float] | dict; a count, rising heights in (0, 1] or a spacing; default as the
            walls' own meshes have rows, else about as high as the quads are wide
        size: float | Callable[[float, float, float], float]; edge length on the source; default: the rim's
            spacing
        curvature: int; sides for a full turn where the size is coarser; default 12; 0: the size alone
        gap: int; quads asked for across a narrow place of the source; default: none, 3 where there is no size
        max_deviation: float; how far the skin may be from the sealed skin [model length]; default: a quarter
            of a quad's side
        quads: "auto" | "paved" | "mapped" | "gmsh" | "keep"; default "auto"; the report says which way each
            face was meshed
        fallback: "wedges" | "leave_out" | "mixed"; what becomes of a volume that cannot be hexahedra alone;
            default: an error
        wedges: bool; triangles that an end came with stay, with wedges on them; default False: quads among
            triangles are an error
        rows: int; rows of quads from every loop of the source that stay as they are laid; default: what the
            paver finds good
        row_height: float | Callable[[float, float, float], float]; of those rows (one at least); default: the
            size
        boundary_layers: dict | list[dict]; thin rows of cells along walls and ends
        intervals: list[list[Any]]; numbers of sides on edges, walls and along the sweep
        periodic: list[list[Any]]; faces with the same mesh under a translation or rotation
        order: 1 | 2; of the cells: hex8, or hex27 with middle nodes on curves and surfaces; default 1
        serendipity: bool; with order 2: hex20 instead of hex27; default False
        min_scaled_jacobian: float; below it the mesh is refused; default 0
        improve: bool | dict; default True; iterations of each descent, 60
        interior: "auto" | "affine" | "residual" | "normals"; how layers are placed; all but "auto" for
            comparison
        threads: int; default: all cores
        contacts: dict; ties and contacts of faces without common nodes

        A dict for `layers` has:
        count: int
        bias: float; last over first layer height (geometric), middle over end (bell), end over middle
            (both_ends)
        mode: "geometric" | "bell" | "both_ends"; default "geometric"

        A dict for `boundary_layers` has:
        walls: Face | int | str | dict | list[Face | int | str | dict]; walls and ends; "walls": all walls,
            "void:<n>": a void face
        first: float; thickness of the cells at the face, square to it [model length]
        growth: float; thickness of each row over the one before; default 1
        count: int; rows; default 1

        One of `intervals`: What, how many sides, and the last length over the first (default 1). What: an
        edge's tag, the tags of two vertices, a wall by Face, name or selector, or "sweep" for the layers.

        A dict for `periodic` has:
        [1]: Face | int | str | dict | list[Face | int | str | dict]
        [2]: Face | int | str | dict | list[Face | int | str | dict]
        translate: (x, y, z)
        rotate: list[(x, y, z) | float]; point, direction, degrees

        A dict for `contacts` has:
        gap: float; of pairs without an entry; default 0 [model length]
        type: "tie" | "contact"; of pairs without an entry; default "tie"
        pairs: list[dict]; pairs with a gap, type or name of their own
        """
        return self._method("sweep", options_of(options, keywords))

    def sweep_to(self, path, options=None, /, **keywords):
        """Sweep and write a layer at a time, as Volume.sweep_to: the bytes of sweep(...).write(path).

        layers: int | list[float] | dict; a count, rising heights in (0, 1] or a spacing; default as the
            walls' own meshes have rows, else about as high as the quads are wide
        size: float | Callable[[float, float, float], float]; edge length on the source; default: the rim's
            spacing
        curvature: int; sides for a full turn where the size is coarser; default 12; 0: the size alone
        gap: int; quads asked for across a narrow place of the source; default: none, 3 where there is no size
        max_deviation: float; how far the skin may be from the sealed skin [model length]; default: a quarter
            of a quad's side
        quads: "auto" | "paved" | "mapped" | "gmsh" | "keep"; default "auto"; the report says which way each
            face was meshed
        fallback: "wedges" | "leave_out" | "mixed"; what becomes of a volume that cannot be hexahedra alone;
            default: an error
        wedges: bool; triangles that an end came with stay, with wedges on them; default False: quads among
            triangles are an error
        rows: int; rows of quads from every loop of the source that stay as they are laid; default: what the
            paver finds good
        row_height: float | Callable[[float, float, float], float]; of those rows (one at least); default: the
            size
        boundary_layers: dict | list[dict]; thin rows of cells along walls and ends
        intervals: list[list[Any]]; numbers of sides on edges, walls and along the sweep
        periodic: list[list[Any]]; faces with the same mesh under a translation or rotation
        order: 1 | 2; of the cells: hex8, or hex27 with middle nodes on curves and surfaces; default 1
        serendipity: bool; with order 2: hex20 instead of hex27; default False
        min_scaled_jacobian: float; below it the mesh is refused; default 0
        improve: bool | dict; default True; iterations of each descent, 60
        interior: "auto" | "affine" | "residual" | "normals"; how layers are placed; all but "auto" for
            comparison
        threads: int; default: all cores
        write: dict; how the file is written; default as mesh.write

        A dict for `layers` has:
        count: int
        bias: float; last over first layer height (geometric), middle over end (bell), end over middle
            (both_ends)
        mode: "geometric" | "bell" | "both_ends"; default "geometric"

        A dict for `boundary_layers` has:
        walls: Face | int | str | dict | list[Face | int | str | dict]; walls and ends; "walls": all walls,
            "void:<n>": a void face
        first: float; thickness of the cells at the face, square to it [model length]
        growth: float; thickness of each row over the one before; default 1
        count: int; rows; default 1

        One of `intervals`: What, how many sides, and the last length over the first (default 1). What: an
        edge's tag, the tags of two vertices, a wall by Face, name or selector, or "sweep" for the layers.

        A dict for `periodic` has:
        [1]: Face | int | str | dict | list[Face | int | str | dict]
        [2]: Face | int | str | dict | list[Face | int | str | dict]
        translate: (x, y, z)
        rotate: list[(x, y, z) | float]; point, direction, degrees
        """
        return self._method("sweep_to", path, options_of(options, keywords))


class AssemblyMesh(AnyMesh):
    """The mesh of an assembly, a region each."""

    __slots__ = ()

    @property
    def contacts(self):
        """ties and contacts"""
        return shaped(self._field("contacts"), ('list', ('of', 'Contact')))

    @property
    def interface_cells(self):
        """cells of no thickness, from `lacuna.split_interface`"""
        return self._field("interface_cells")

    @property
    def left_out(self):
        """volumes and pieces that `fallback = "leave_out"` left out"""
        return shaped(self._field("left_out"), ('list', ('of', 'LeftOut')))

    @property
    def fidelity(self):
        return shaped(self._field("fidelity"), ('of', 'AssemblyFidelity'))

    @property
    def nodes(self):
        return self._field("nodes")

    @property
    def hexes(self):
        return self._field("hexes")

    @property
    def wedges(self):
        return self._field("wedges")

    @property
    def pyramids(self):
        return self._field("pyramids")

    @property
    def tets(self):
        return self._field("tets")

    @property
    def order(self):
        return self._field("order")

    @property
    def layers(self):
        """by region"""
        return self._field("layers")

    @property
    def regions(self):
        return self._field("regions")

    @property
    def report(self):
        return self._field("report")

    def quality(self):
        """Scaled Jacobian, certificate, volume and other metrics of all cells."""
        return self._method("quality")

    def groups(self):
        """Groups of quads and cells, as files have them; each volume's cells are one."""
        return self._method("groups")

    def copy(self, options=None, /, **keywords):
        """A copy, moved as a whole; a mirrored one is turned over, so that its cells stay positive.

        translate: (x, y, z)
        rotate: list[(x, y, z) | float]; point, direction and angle [degrees]
        mirror: list[(x, y, z)]; point and normal of the plane
        name: str; region of the copy; of several regions the start of their names; default: as the mesh
        """
        return self._method("copy", options_of(options, keywords))

    def pattern(self, count, **keywords):
        """The mesh and copies of it, each moved against the one before, as one mesh.

        translate: (x, y, z); from each copy to the next
        rotate: list[(x, y, z) | float]; point, direction and angle [degrees]
        count: int; copies, the mesh itself included
        numbered: bool; regions are name_1, name_2 and so on; default False: copies are one region
        """
        return self._method("pattern", options_of(None, keywords, count=count))

    def node(self, i):
        """Coordinates of a node."""
        return self._method("node", i)

    def hex(self, i):
        """Eight node numbers, Gmsh order."""
        return self._method("hex", i)

    def coordinates(self):
        """Of every node x, y, z."""
        return self._array("coordinates")

    def cells(self, kind=None):
        """Of every cell of a kind the numbers of its nodes, from 1; of order 2 the middle nodes too, in VTK's
        order.

        kind: default "hex"
        """
        return self._array("cells", kind)

    def field(self, metric=None, kind=None):
        """A metric of every cell of a kind, in the order of `cells(kind)`. Of order 2 by the corners.

        metric: default "scaled_jacobian"; of cells that are no hexahedra also "jacobian" and "volume"
        kind: default "hex"
        """
        return self._array("field", metric, kind)

    def wedge(self, i):
        """Six node numbers, Gmsh order."""
        return self._method("wedge", i)

    def pyramid(self, i):
        """Four node numbers of the base, and the apex."""
        return self._method("pyramid", i)

    def tet(self, i):
        """Four node numbers, Gmsh order."""
        return self._method("tet", i)

    def write(self, path, options=None, /, **keywords):
        """A file in the format of its ending.

        version: float
        binary: bool
        with_: Model | list[Model]; loaded from finite element meshes, that the mesh is joined to; the
            volume's first
        without: str | int | list[str | int]; regions, properties, sets or parts of these models that are left
            out
        renumber: bool; numbers and names that several decks have in common become others; default False
        first_node: int; of decks and with a model; default above all that are taken
        first_cell: int; likewise
        element: str; Abaqus's word for the hexahedra of .inp; default "C3D8", of order 2 "C3D20"; thin
            layers: "COH3D8", "GK3D8", "SC8R", "CSS8"
        groups: "one" | "all"; of .msh: whether cells are in one physical group or in all of theirs, which
            overlap; default "one"
        gmsh_options: bool; of .msh: a file beside it, .opt behind its name, with which Gmsh shows cells and
            groups; default False
        interfaces: bool; of an assembly: quads between its volumes are elements too; default False
        orientation: bool; directions of cells: fields in .vtu, .vtk and .exo, material axes in .inp and .bdf;
            default False
        partitions: int | "processes"; of .pvtu and .msh: parts; of .pvtu default as many as processes
        ghosts: int; rows of other parts' cells that are marked as each part's ghosts; default 0
        """
        self._method("write", path, options_of(options, keywords))

    def view(self, path, options=None, /, **keywords):
        """A page for a browser, regions told apart.

        path: .html
        title: str; default: what the input is called
        """
        self._method("view", path, options_of(options, keywords))

    def picture(self, path, options=None, /, **keywords):
        """Drawn without a display.

        path: .png
        width: int; default 1200 [pixels]
        height: int; default 900 [pixels]
        view: (x, y, z) | "iso" | "front" | "back" | "left" | "right" | "top" | "bottom"; from what is seen to
            the eye; default "iso"
        colour: "quality" | "layer" | "groups" | "region" | "origin"; default "quality"
        cut: dict; cells whose centre lies behind the plane are shown whole
        layers: list[int]; first and last that is shown; default all
        edges: bool; sides of cells; default True
        legend: bool; a title, and what the colours mean; default True
        title: str; default the name of the mesh and its counts
        """
        self._method("picture", path, options_of(options, keywords))


class QuadMesh(AnyMesh):
    """Quads on faces, without layers."""

    __slots__ = ()

    @property
    def nodes(self):
        return self._field("nodes")

    @property
    def quads(self):
        return self._field("quads")

    @property
    def triangles(self):
        """that faces came with"""
        return self._field("triangles")

    @property
    def hexes(self):
        """0"""
        return self._field("hexes")

    @property
    def layers(self):
        """0"""
        return self._field("layers")

    @property
    def order(self):
        return self._field("order")

    @property
    def regions(self):
        """names of faces"""
        return self._field("regions")

    @property
    def report(self):
        return self._field("report")

    def quality(self):
        """Of the corners, in their planes; areas of the quads and of the faces."""
        return self._method("quality")

    def groups(self):
        return self._method("groups")

    def node(self, i):
        return self._method("node", i)

    def quad(self, i):
        """Returns ... four numbers of nodes"""
        return self._method("quad", i)

    def model(self):
        """The quads as faces that keep them, to be swept."""
        return self._method("model")

    def coordinates(self):
        """Of every node x, y, z."""
        return self._array("coordinates")

    def cells(self, kind=None):
        """Of every cell the numbers of its nodes, from 1.

        kind: default "quad"
        """
        return self._array("cells", kind)

    def write(self, path, options=None, /, **keywords):
        """path: .msh, .vtu, .vtk, .inp, .bdf, .nas, .dat, .unv, .exo or .e
        version: float; of a .msh
        binary: bool
        groups: "one" | "all"; of a .msh: quads in one of their groups, or in all
        gmsh_options: bool; a file beside a .msh that says how Gmsh shows it
        """
        self._method("write", path, options_of(options, keywords))

    def view(self, path, options=None, /, **keywords):
        """path: .html
        title: str; default: what the input is called
        """
        self._method("view", path, options_of(options, keywords))

    def picture(self, path, options=None, /, **keywords):
        """path: .png
        width: int; default 1200 [pixels]
        height: int; default 900 [pixels]
        facets: bool; sides of the facets are drawn; default False
        legend: bool; a title, and what the colours mean; default True
        title: str; default what is shown, counted
        view: (x, y, z) | "iso" | "front" | "back" | "left" | "right" | "top" | "bottom"; from what is seen to
            the eye; default "iso"
        """
        self._method("picture", path, options_of(options, keywords))


class Quality(Object):
    """Prints as a table, with a histogram and a line a metric."""

    __slots__ = ()
    _at_once = False

    @property
    def hexes(self):
        return self._field("hexes")

    @property
    def wedges(self):
        return self._field("wedges")

    @property
    def pyramids(self):
        return self._field("pyramids")

    @property
    def tets(self):
        return self._field("tets")

    @property
    def least(self):
        """smallest scaled Jacobian of each kind of cell that occurs"""
        return self._field("least")

    @property
    def min_scaled_jacobian(self):
        return self._field("min_scaled_jacobian")

    @property
    def mean_scaled_jacobian(self):
        return self._field("mean_scaled_jacobian")

    @property
    def inverted(self):
        """cells with a corner that is not positive"""
        return self._field("inverted")

    @property
    def uncertified(self):
        """cells whose Jacobian was not shown positive everywhere"""
        return self._field("uncertified")

    @property
    def certified(self):
        """every cell is"""
        return self._field("certified")

    @property
    def worst(self):
        """at most ten, worst first; of a swept mesh one of each column"""
        return shaped(self._field("worst"), ('list', ('of', 'WorstCell')))

    @property
    def histogram(self):
        """of the scaled Jacobian, twenty bins over [-1, 1]"""
        return self._field("histogram")

    @property
    def metrics(self):
        """in order and by name; measured when first asked for"""
        return shaped(self._field("metrics"), ('rows', ('of', 'MetricSummary')))

    @property
    def volume(self):
        """[model length³]"""
        return self._field("volume")


def load(path, options=None, /, **keywords):
    """The faces of a file, or of several as one model: CAD (.step .stp .iges .igs .brep .geo), facets (.stl
    .obj), meshes and decks (.msh .inp .bdf .nas .dat .unv .vtk .vtu .exo .e .mesh). In the place of a path: a
    mesh of meshio or PyVista.

    tolerance: float; gaps below it are sewn [model length]; default 1e-6 × the diagonal
    feature_angle: float; where facets are cut into faces [degrees]; default 40
    keep_mesh: bool; given quads and nodes stay as they are; default True
    keep_noise: bool; points of noisy facets, as of a scan, stay where they are; default False: they are
        smoothed
    scale: float; every coordinate times this; default 1
    unit: "um" | "mm" | "cm" | "m" | "in" | "ft"; declared unit of the model's lengths; STEP and IGES are
        converted to it
    cad_seconds: float; processor time the CAD process may take over it; in the sandbox it only lowers
    cad_megabytes: float; address space the CAD process may take; in the sandbox it only lowers
    without: str | int | list[str | int]; regions, properties, sets or parts of meshes that are left out
    """
    return loaded(path, options_of(options, keywords))


def model(options=None, /, **keywords):
    """An empty model, to add faces to.

    tolerance: float; points closer than this are one [model length]; default 1e-6 × the diagonal
    """
    return call("module", "model", options_of(options, keywords))


def assembly(volumes):
    """Volumes that share faces, to be meshed as one. Meshes among them stay as they are."""
    return call("module", "assembly", volumes)


def split_interface(mesh, faces, **keywords):
    """Double the nodes of faces between two regions or layers, and put a cell of no thickness on each.

    faces: str | int | list[str | int | list[str]]; "all", a group, or an array of groups and pairs of
        regions; in the mesh of one sweep also numbers of layers, each the number below a split
    element: str; Abaqus's word for the cells: "COH3D8", "GK3D8" or one that begins so, or "none"; default
        "COH3D8"
    name: str; region and group of the cells; default "interface"
    """
    return call("module", "split_interface", mesh, options_of(None, keywords, faces=faces))


def check(path):
    """Quality of the solids of a mesh or deck in any format that is read; of a file without solids that of
    its quads, as QuadMesh:quality()."""
    return call("module", "check", path)


def convert(from_, to, options=None, /, **keywords):
    """A mesh or deck in any format that is read, in the format of the other's ending.

    to: .msh .vtu .vtk .inp .bdf .nas .dat .unv .exo .e .k .feb .med
    version: float; of .msh; default 4.1
    binary: bool; of .msh and .vtk; default True
    groups: "one" | "all"; of .msh; default "one"
    """
    return call("module", "convert", from_, to, options_of(options, keywords))


def view(file, path, options=None, /, **keywords):
    """A page of a file for a browser: the cells of a mesh or deck that has solids, else faces.

    file: in any format that is read
    path: .html
    title: str; default: what the input is called
    show: "auto" | "faces" | "cells"; default "auto": cells of meshes that have solids, else faces
    """
    return call("module", "view", file, path, options_of(options, keywords))


classes.update(Contact=Contact, ModelInfo=ModelInfo, FaceInfo=FaceInfo, Cavity=Cavity,
               Classification=Classification, Match=Match, Closure=Closure, FreeEdge=FreeEdge,
               LeftOut=LeftOut, Fidelity=Fidelity, FaceFidelity=FaceFidelity,
               AssemblyFidelity=AssemblyFidelity, WorstCell=WorstCell, MetricSummary=MetricSummary,
               Model=Model, Face=Face, Volume=Volume, Mesh=Mesh, Assembly=Assembly, AssemblyMesh=AssemblyMesh,
               QuadMesh=QuadMesh, Quality=Quality)

for made in classes.values():
    made.__module__ = "lacuna"
