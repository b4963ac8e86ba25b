# SPDX-License-Identifier: MIT
# Made by python/generate.py from lua/lacuna.d.lua.
"""Classes and functions, as lacuna.d.lua has them."""
from ._objects import (AnyFace, AnyMesh, Object, Shown, Table, call, classes, loaded,
                       options_of, shaped)

__all__ = [
        "Contact", "ModelInfo", "FaceInfo", "Cavity", "Classification", "Match", "Closure", "FreeEdge",
        "LeftOut", "Fidelity", "FaceFidelity", "AssemblyFidelity", "WorstCell", "MetricSummary", "Model",
        "Face", "Volume", "Mesh", "Assembly", "AssemblyMesh", "QuadMesh", "Quality", "load", "model",
        "assembly", "split_interface", "check", "convert", "view", "picture",
]


class Contact(Table):
    """Two bodies whose faces touch or face each other.

    a: str; region
    b: str; region
    name: str; name of the pair; default: a_b
    type: "tie" | "contact"; default "tie"
    gap: float; largest distance of the faces [model length]
    faces: list[list[int]]; pairs of tags of the faces in contact
    least: float; smallest distance between the faces [model length]
    width: float; largest distance between the faces [model length]
    area: float; area of the faces of `a` that are within the gap [model length²]
    slave: str; name of the slave group in a mesh
    master: str; name of the master group in a mesh
    """

    __slots__ = ()
    _shapes = {}
    _optional = ['name', 'type', 'gap', 'faces', 'least', 'width', 'area', 'slave', 'master']


class ModelInfo(Table):
    """source: str
    diagonal: float; [model length]
    tolerance: float; [model length]
    parts: int; number of connected components of the faces
    closed_parts: int; number of components without free edges
    faces: list[FaceInfo]
    free_edges: list[Table]
    gaps: list[Table]; `tolerance`: the smallest that closes the gap
    cavities: list[Cavity]
    """

    __slots__ = ()
    _shapes = {'faces': ('list', ('of', 'FaceInfo')), 'cavities': ('list', ('of', 'Cavity'))}
    _optional = []


class FaceInfo(Table):
    """tag: int; the tag that Gmsh gives the face when it opens the same file
    name: str
    kind: str
    area: float; [model length²]
    normal: list[float]; mean unit normal; zero for a closed tube
    centroid: list[float]
    loops: int; number of boundary loops
    edges: int
    has_mesh: bool
    radius: float; radius of the cylinder or sphere fitted to its facets [model length]
    axis: list[float]; direction of the axis of this cylinder
    box: list[list[float]]; bounding box: the smallest and the largest coordinates
    neighbours: list[int]; tags of faces that share an edge with it
    fits: "cylinder" | "sphere" | "cone"; surface fitted to its facets
    centre: list[float]; centre of this cylinder or sphere
    apex: list[float]; apex of this cone; `axis` points from it into the cone
    half_angle: float; angle between axis and surface of this cone [degrees]
    least_radius: float; smallest radius of the face on this cone [model length]
    largest_radius: float; largest radius of the face on this cone [model length]
    free_edges: int; number of free edges
    part: int; number of the connected component of faces
    cavity: int; index in `cavities`
    use: str; the kind of its cavity, "outer skin" or "open shell"
    """

    __slots__ = ()
    _shapes = {}
    _optional = ['radius', 'axis', 'fits', 'centre', 'apex', 'half_angle', 'least_radius', 'largest_radius',
                 'cavity']


class Cavity(Table):
    """kind: "pocket" | "bore" | "slot" | "inner void"
    faces: list[int]; tags, for open_volume(faces=…); with those of the bodies in it
    class_: "I" | "II" | "III" | "IV" | "V" | "closed" | "0"
    volume: float; volume of the sealed cavity [model length³]
    """

    __slots__ = ()
    _shapes = {}
    _optional = []


class Classification(Table):
    """class_: "I" | "II" | "III" | "IV" | "V" | "closed" | "0"
    free_loops: int; number of closed loops of free edges
    wall_free_source: list[int]; tags of the source's vertices that lie on no wall
    wall_free_target: list[int]; tags of the target's vertices that lie on no wall
    reasons: list[str]
    """

    __slots__ = ()
    _shapes = {}
    _optional = []


class Match(Table):
    """loops: list[Table]
    vertices: list[list[int]]; pairs of vertex tags: source, target
    method: str
    confidence: float; from 0 to 1; 1 where nothing had to be guessed
    notes: list[str]
    """

    __slots__ = ()
    _shapes = {}
    _optional = []


class Closure(Table):
    """void_edges: int; number of generated edges
    void_faces: int; number of generated faces
    void_edge_tags: list[int]
    void_face_tags: list[int]
    watertight: bool
    algorithms: list[str]; names of the paper's algorithms, in the order used
    """

    __slots__ = ()
    _shapes = {}
    _optional = []


class FreeEdge(Table):
    """tag: int
    from_: int; tag of the first vertex
    to: int; tag of the last vertex
    length: float; [model length]
    """

    __slots__ = ()
    _shapes = {}
    _optional = []


class LeftOut(Table):
    """region: str
    code: str; code of the error
    message: str
    """

    __slots__ = ()
    _shapes = {}
    _optional = []


class Fidelity(Table):
    """How far the boundary of the mesh is from the boundary of the sealed volume.

    volume: float; volume of the cells [model length³]
    sealed_volume: float; [model length³]
    max_distance: float; [model length]
    mean_distance: float; [model length]
    faces: dict[int | str, FaceFidelity]; by tag, generated faces by "void:<n>"
    """

    __slots__ = ()
    _shapes = {'faces': ('map', ('of', 'FaceFidelity'))}
    _optional = []


class FaceFidelity(Table):
    """quads: int; number of the mesh's boundary quads on the face
    max_distance: float; largest distance [model length]; of a face without quads, its width
    mean_distance: float; [model length]
    place: list[float]; point of the largest distance
    """

    __slots__ = ()
    _shapes = {}
    _optional = []


class AssemblyFidelity(Table):
    """Fidelity of an assembly: its totals, and each volume's.

    volume: float; volume of the cells [model length³]
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
    cells: int; number of cells for which the metric is defined
    min: float
    mean: float
    max: float
    deviation: float; standard deviation
    acceptable: list[float]; acceptable range according to Cubit; None where it depends on the application
    outside: int; number of cells outside the acceptable range
    outside_share: float; fraction of the cells outside the acceptable range, 0 to 1
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

    @property
    def regions(self):
        """names of the closed bodies, in the order of `bodies()`"""
        return self._field("regions")

    def faces(self, selector=None, /, **keywords):
        """The faces that the selector selects; without one, all faces.

        tags: int | list[int]
        name: str; name of a physical group, a part (`pid:7`) or an element set
        kind: "plane" | "cylinder" | "cone" | "sphere" | "torus" | "bspline" | "surface" | "discrete"
        facing: (x, y, z); faces whose mean normal is within 30 degrees of this direction
        normal_within: float; largest angle from `facing`, instead of 30 [degrees]
        near: (x, y, z); the one face closest to this point
        within: float; with `near`: all faces within this distance instead [model length]
        box: list[(x, y, z)]; two opposite corners of a box that contains the whole face
        touching: Face | int | str; faces that share an edge with this one
        region: str; faces that bound this solid, part or set
        free: bool; True: faces that bound exactly one region; False: faces between two regions
        radius: list[float]; smallest and largest radius, of faces that are parts of cylinders or spheres
            [model length]
        area: list[float]; smallest and largest area [model length²]
        """
        return self._method("faces", options_of(selector, keywords))

    def face(self, which=None, /, **keywords):
        """The one face that `which` selects. If it selects none or several, the error lists the candidates.

        tags: int | list[int]
        name: str; name of a physical group, a part (`pid:7`) or an element set
        kind: "plane" | "cylinder" | "cone" | "sphere" | "torus" | "bspline" | "surface" | "discrete"
        facing: (x, y, z); faces whose mean normal is within 30 degrees of this direction
        normal_within: float; largest angle from `facing`, instead of 30 [degrees]
        near: (x, y, z); the one face closest to this point
        within: float; with `near`: all faces within this distance instead [model length]
        box: list[(x, y, z)]; two opposite corners of a box that contains the whole face
        touching: Face | int | str; faces that share an edge with this one
        region: str; faces that bound this solid, part or set
        free: bool; True: faces that bound exactly one region; False: faces between two regions
        radius: list[float]; smallest and largest radius, of faces that are parts of cylinders or spheres
            [model length]
        area: list[float]; smallest and largest area [model length²]
        """
        return self._method("face", options_of(which, keywords) if keywords else which)

    def face_from(self, near, **keywords):
        """Make a face of the facets around a point. They are removed from the faces they belonged to.

        near: (x, y, z); point next to the first facet of the face [model length]
        angle: float; the face grows across edges where neighbouring facets form at most this angle [degrees];
            default 20
        region: str; grow only on faces that bound this region
        free: bool; True: grow only on faces that bound one region; False: only on faces that bound two
        """
        return self._method("face_from", options_of(None, keywords, near=near))

    def add_face(self, points, cells, **keywords):
        """Add a face of triangles and quads to the model. Points are numbered from 1.

        name: str
        points: list[(x, y, z)] | numpy.ndarray
        cells: list[list[int]] | numpy.ndarray; triangles and quads, as numbers of points, from 1
        keep_mesh: bool; the quads are kept as a mesh; default False: they only describe the shape
        """
        return self._method("add_face", options_of(None, keywords, points=points, cells=cells))

    def open_volume(self, roles=None, /, **keywords):
        """The volume bounded by the faces with the given roles. Without roles, the roles of `faces`, or of
        all faces, are detected.

        source: Face | int | str | dict | list[Face | int | str | dict]
        target: Face | int | str | dict | list[Face | int | str | dict]
        walls: Face | int | str | dict | list[Face | int | str | dict] | "auto"; "auto": in a solid the faces
            of the source's cavity, otherwise all faces connected to the boundary of the source
        faces: Face | int | str | dict | list[Face | int | str | dict]; instead of roles: the faces of the
            volume; their roles are detected
        reading: int; where roles are detected and several volumes are possible: number of the volume, from 1
        full_turn: bool; the walls form a closed ring, swept through 360 degrees without ends; default False
        along: dict; where only a source, and walls if any, are given: the path along which the source is
            swept
        fill_to: list[(x, y, z)] | dict; point and normal, also as keys of these names: only the part of the
            void behind this plane is filled
        class_: "I" | "II" | "III" | "IV" | "V" | "closed" | "0"; class to use instead of the detected one
        name: str; name of the group, set or property of the cells in files; default "volume"
        material: str | int; material of the cells, in decks; default: that of the adjacent elements
        glued: bool; False: in an assembly the volume shares no nodes with the volumes it touches; ties
            connect them; default True

        A dict for `along` has:
        vector: (x, y, z); translation
        axis: list[(x, y, z)]; point and direction of the axis of a rotation by `angle`
        angle: float; angle of the rotation about `axis`, from -360 to 360 [degrees]
        path: list[(x, y, z)] | numpy.ndarray | list[int] | Callable[[float], (x, y, z)]; points with corners,
            tags of edges, or a smooth curve for t from 0 to 1
        frame: "minimal" | "fixed"; with `path`: "minimal": the source rotates with the path's direction,
            without twist; "fixed": it does not rotate; default "minimal"
        helix: list[(x, y, z) | float]; point, direction, pitch and turns; negative turns: left-handed
        normals: float | Callable[[float, float, float], float] | list[float | Callable[[float, float, float],
            float]]; thickness along the source's normals, or [inside, outside]
        to: Face | int | str | dict; the source is projected along its mean normal onto this face
        twist: float | Callable[[float], float]; rotation of the target, or of the section at each height from
            0 to 1 [degrees]
        scale: float | Callable[[float], float]; scale of the target, or of the section at each height from 0
            to 1
        """
        return self._method("open_volume", options_of(roles, keywords))

    def quads(self, options=None, /, **keywords):
        """Quads on faces, without layers.

        faces: Face | int | str | dict | list[Face | int | str | dict]; default: all
        size: float | Callable[[float, float, float], float]; edge length; default: that of the faces'
            boundaries
        curvature: int; least number of edges per full circle where curves and surfaces bend; default 12; 0:
            only the size counts
        gap: int; least number of quads across narrow parts; default: none, 3 where there is no size
        quads: "auto" | "paved" | "mapped" | "gmsh" | "keep"; how faces are meshed; default "auto"; the report
            names the method for each face
        order: 1 | 2; 1: quads of 4 nodes; 2: of 9 nodes, with the mid-side nodes on the curves and surfaces;
            default 1
        serendipity: bool; with order 2: quads of 8 nodes; default False
        threads: int; default: all cores
        """
        return self._method("quads", options_of(options, keywords))

    def bodies(self):
        """A volume for each closed body: the solids of CAD, the regions of meshes, or else the closed parts."""
        return self._method("bodies")

    def contacts(self, options=None, /, **keywords):
        """Bodies whose faces touch or face each other.

        gap: float; largest distance between the faces; default 0: only faces that touch [model length]
        """
        return shaped(self._method("contacts", options_of(options, keywords)), ('list', ('of', 'Contact')))

    def describe(self):
        """Faces, free edges, gaps and cavities, as text."""
        return self._method("describe")

    def info(self):
        """The information of `describe`, as a table."""
        return shaped(self._method("info"), ('of', 'ModelInfo'))

    def cavities(self):
        """Pockets, bores, slots and inner voids of closed surfaces."""
        return shaped(self._method("cavities"), ('list', ('of', 'Cavity')))

    def view(self, path, options=None, /, **keywords):
        """Write an HTML page with the labelled faces; clicking on them sets the roles for a recipe.

        path: .html
        title: str; title of the page; default: the name of the input
        """
        self._method("view", path, options_of(options, keywords))

    def picture(self, path, options=None, /, **keywords):
        """Write a picture of the faces and their free edges. No display is needed.

        path: .png
        width: int; default 1200 [pixels]
        height: int; default 900 [pixels]
        facets: bool; draw the edges of the facets; default False
        legend: bool; show a title and a key to the colours; default True
        title: str; default: name and numbers of what is shown
        view: (x, y, z) | "iso" | "front" | "back" | "left" | "right" | "top" | "bottom"; direction from the
            object to the viewer; default "iso"
        """
        self._method("picture", path, options_of(options, keywords))


class Face(AnyFace):
    __slots__ = ()

    @property
    def tag(self):
        """the tag that Gmsh gives the face when it opens the same file"""
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
        """mean unit normal; zero for a closed tube"""
        return self._field("normal")

    @property
    def centroid(self):
        return self._field("centroid")

    @property
    def loops(self):
        """number of boundary loops"""
        return self._field("loops")

    @property
    def edges(self):
        return self._field("edges")

    @property
    def has_mesh(self):
        return self._field("has_mesh")

    @property
    def radius(self):
        """radius of the cylinder or sphere fitted to its facets [model length]"""
        return self._field("radius")

    @property
    def axis(self):
        """direction of the axis of this cylinder"""
        return self._field("axis")

    @property
    def box(self):
        """bounding box: the smallest and the largest coordinates"""
        return self._field("box")

    @property
    def neighbours(self):
        """tags of faces that share an edge with it"""
        return self._field("neighbours")


class Volume(Shown):
    __slots__ = ()

    @property
    def class_(self):
        """class of the input, before `close`"""
        return self._field("class")

    def classify(self):
        """The class of the volume, the reasons for it, and what is missing."""
        return shaped(self._method("classify"), ('of', 'Classification'))

    def override_class(self, class_):
        """Set the class of the volume. It is an error if the faces contradict the class."""
        return self._method("override_class", class_)

    def match(self, options=None, /, **keywords):
        """Pair the loops and vertices of source and target. `close` does this where it was not called.

        vertices: list[list[int]] | numpy.ndarray; pairs of vertex tags: source, target
        loops: list[list[int]] | numpy.ndarray; pairs of loop numbers: source, target
        flip: list[int]; numbers of source loops whose direction on the target is reversed
        method: "aligned" | "nearest"; default "aligned"
        """
        return shaped(self._method("match", options_of(options, keywords)), ('of', 'Match'))

    def close(self, options=None, /, **keywords):
        """Generate the missing edges and faces; afterwards the volume is sealed. `sweep` does this where it
        was not called.

        edge_shape: "auto" | "straight" | "follow" | "smooth"; shape of the missing edges; default "auto"
        void_edges: list[list[int | list[(x, y, z)] | numpy.ndarray]]; edges given by the user: tags of the
            first and last vertex, points between them
        cap: "auto" | "flat" | "parallel"; shape of a missing end; default "auto"
        holes: "cover" | "through"; holes of a given end without walls: cover them, or continue them through
            the volume; required where the other end is missing
        """
        return shaped(self._method("close", options_of(options, keywords)), ('of', 'Closure'))

    def is_watertight(self):
        """Whether the volume's boundary is closed."""
        return self._method("is_watertight")

    def free_edges(self):
        """Edges with a face on only one side."""
        return shaped(self._method("free_edges"), ('list', ('of', 'FreeEdge')))

    def tree(self):
        """Volume, faces, edges and vertices, with the geometry of each, as text. Generated ones are marked."""
        return self._method("tree")

    def describe(self):
        """Roles, class, missing faces and the pairs of vertices, as text."""
        return self._method("describe")

    def view(self, path, options=None, /, **keywords):
        """Write an HTML page with roles, generated faces, free edges and vertices on no wall.

        path: .html
        title: str; title of the page; default: the name of the input
        """
        self._method("view", path, options_of(options, keywords))

    def picture(self, path, options=None, /, **keywords):
        """Write a picture of the given and the generated faces. No display is needed.

        path: .png
        width: int; default 1200 [pixels]
        height: int; default 900 [pixels]
        facets: bool; draw the edges of the facets; default False
        legend: bool; show a title and a key to the colours; default True
        title: str; default: name and numbers of what is shown
        view: (x, y, z) | "iso" | "front" | "back" | "left" | "right" | "top" | "bottom"; direction from the
            object to the viewer; default "iso"
        """
        self._method("picture", path, options_of(options, keywords))

    def cut(self, options=None, /, **keywords):
        """Cut the volume by a plane or a face into pieces that share the cut. Without options a volume is cut
        where it branches, or where an end lies at several heights; otherwise the result is the volume itself.

        plane: list[(x, y, z)] | dict; point and normal, also as keys of these names
        face: Face | int | str | dict; a Face of any model, or a face of the volume
        auto: bool; cut where the pieces can be swept: along planes at concave edges, or into blocks at the
            vertices
        """
        return self._method("cut", options_of(options, keywords))

    def model(self):
        """The volume's faces, including the generated ones, as a model."""
        return self._method("model")

    def sweep(self, options=None, /, **keywords):
        """Mesh the volume by sweeping. It is closed first where `close` was not called. A volume with steps
        is cut into pieces that are meshed as an assembly.

        layers: int | list[float] | dict; a count, increasing heights in (0, 1] or a spacing; default: the
            rows of the walls' given meshes, otherwise layers about as high as the quads are wide
        size: float | Callable[[float, float, float], float]; edge length on the source; default: that of the
            source's boundary
        curvature: int; least number of edges per full circle where curves and surfaces bend; default 12; 0:
            only the size counts
        gap: int; least number of quads across narrow parts of the source; default: none, 3 where there is no
            size
        max_deviation: float; largest distance of the mesh's boundary from the volume's [model length];
            default: a quarter of a quad's edge
        quads: "auto" | "paved" | "mapped" | "gmsh" | "keep"; how faces are meshed; default "auto"; the report
            names the method for each face
        fallback: "none" | "wedges" | "leave_out" | "mixed"; what to do with a volume that cannot be meshed
            with hexahedra only; default: an error
        wedges: bool; triangles of an end's given mesh are kept, and wedges swept from them; default False: an
            end with both triangles and quads is an error
        rows: int; rows of quads along every loop of the source that are not moved afterwards; default: chosen
            by the paving method
        row_height: float | Callable[[float, float, float], float]; height of these rows, of which there is at
            least one; default: the size
        boundary_layers: dict | list[dict]; rows of thin cells along walls and ends
        intervals: list[list[Any]]; numbers of edges on curves, walls and along the sweep
        periodic: list[list[Any]]; pairs of faces with the same mesh, up to a translation or rotation
        order: 1 | 2; 1: hex8; 2: hex27, with the mid-side and mid-face nodes on the curves and surfaces;
            default 1
        serendipity: bool; with order 2: hex20 instead of hex27; default False
        min_scaled_jacobian: float; a mesh with a smaller value is an error; default 0
        improve: bool | dict; optimise the positions of nodes; `iterations` of each optimisation, 60; default
            True
        threads: int; default: all cores

        A dict for `layers` has:
        count: int
        bias: float; ratio of layer heights: last to first (geometric), middle to end (bell), end to middle
            (both_ends)
        mode: "geometric" | "bell" | "both_ends"; default "geometric"

        A dict for `boundary_layers` has:
        walls: Face | int | str | dict | list[Face | int | str | dict]; walls or ends; "walls": all walls,
            "void:<n>": a generated face
        first: float; thickness of the first row of cells, normal to the face [model length]
        growth: float; ratio of the thicknesses of successive rows; default 1
        count: int; number of rows; default 1

        One of `intervals`: Where the interval applies, its number of edges, and the ratio of the last edge
        length to the first (default 1). It applies to an edge by its tag, to two vertices by their tags, to a
        wall by its Face, name or selector, or to the layers with "sweep".

        A dict for `periodic` has:
        [1]: Face | int | str | dict | list[Face | int | str | dict]
        [2]: Face | int | str | dict | list[Face | int | str | dict]
        translate: (x, y, z)
        rotate: list[(x, y, z) | float]; point, direction, degrees
        """
        return self._method("sweep", options_of(options, keywords))

    def sweep_to(self, path, options=None, /, **keywords):
        """Sweep and write one layer at a time; the memory needed hardly depends on the number of layers. The
        file is the same as that of sweep(...).write(path). The report has nodes, hexes, wedges, layers,
        min_scaled_jacobian, streamed, processes (with mpirun) and seconds by stage.

        path: .msh, .vtu, .pvtu, .vtk, .inp, .bdf, .nas, .dat, .unv, .exo, .e, .k or .feb
        layers: int | list[float] | dict; a count, increasing heights in (0, 1] or a spacing; default: the
            rows of the walls' given meshes, otherwise layers about as high as the quads are wide
        size: float | Callable[[float, float, float], float]; edge length on the source; default: that of the
            source's boundary
        curvature: int; least number of edges per full circle where curves and surfaces bend; default 12; 0:
            only the size counts
        gap: int; least number of quads across narrow parts of the source; default: none, 3 where there is no
            size
        max_deviation: float; largest distance of the mesh's boundary from the volume's [model length];
            default: a quarter of a quad's edge
        quads: "auto" | "paved" | "mapped" | "gmsh" | "keep"; how faces are meshed; default "auto"; the report
            names the method for each face
        fallback: "none" | "wedges" | "leave_out" | "mixed"; what to do with a volume that cannot be meshed
            with hexahedra only; default: an error
        wedges: bool; triangles of an end's given mesh are kept, and wedges swept from them; default False: an
            end with both triangles and quads is an error
        rows: int; rows of quads along every loop of the source that are not moved afterwards; default: chosen
            by the paving method
        row_height: float | Callable[[float, float, float], float]; height of these rows, of which there is at
            least one; default: the size
        boundary_layers: dict | list[dict]; rows of thin cells along walls and ends
        intervals: list[list[Any]]; numbers of edges on curves, walls and along the sweep
        periodic: list[list[Any]]; pairs of faces with the same mesh, up to a translation or rotation
        order: 1 | 2; 1: hex8; 2: hex27, with the mid-side and mid-face nodes on the curves and surfaces;
            default 1
        serendipity: bool; with order 2: hex20 instead of hex27; default False
        min_scaled_jacobian: float; a mesh with a smaller value is an error; default 0
        improve: bool | dict; optimise the positions of nodes; `iterations` of each optimisation, 60; default
            True
        threads: int; default: all cores
        write: dict; options of the file, as of mesh.write

        A dict for `layers` has:
        count: int
        bias: float; ratio of layer heights: last to first (geometric), middle to end (bell), end to middle
            (both_ends)
        mode: "geometric" | "bell" | "both_ends"; default "geometric"

        A dict for `boundary_layers` has:
        walls: Face | int | str | dict | list[Face | int | str | dict]; walls or ends; "walls": all walls,
            "void:<n>": a generated face
        first: float; thickness of the first row of cells, normal to the face [model length]
        growth: float; ratio of the thicknesses of successive rows; default 1
        count: int; number of rows; default 1

        One of `intervals`: Where the interval applies, its number of edges, and the ratio of the last edge
        length to the first (default 1). It applies to an edge by its tag, to two vertices by their tags, to a
        wall by its Face, name or selector, or to the layers with "sweep".

        A dict for `periodic` has:
        [1]: Face | int | str | dict | list[Face | int | str | dict]
        [2]: Face | int | str | dict | list[Face | int | str | dict]
        translate: (x, y, z)
        rotate: list[(x, y, z) | float]; point, direction, degrees
        """
        return self._method("sweep_to", path, options_of(options, keywords))

    def write_facets(self, path, options=None, /, **keywords):
        """Write the facets of the sealed volume: a closed surface with outward normals.

        path: .stl, .msh or .obj
        binary: bool
        groups: "one" | "all"
        """
        self._method("write_facets", path, options_of(options, keywords))

    def write_cad(self, path, options=None, /, **keywords):
        """Write the sealed volume as one CAD solid: given CAD faces exactly, generated faces as planes or
        fitted surfaces.

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
        """empty"""
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
        """the name of the volume"""
        return self._field("regions")

    @property
    def report(self):
        return self._field("report")

    def quality(self):
        """Scaled Jacobian, certificate, volume and other metrics of the cells."""
        return self._method("quality")

    def groups(self):
        """Groups of quads and cells, as they are written to files."""
        return self._method("groups")

    def copy(self, options=None, /, **keywords):
        """A translated, rotated or mirrored copy. In a mirrored copy the node order of each cell is reversed,
        so that the cells stay positive.

        translate: (x, y, z)
        rotate: list[(x, y, z) | float]; point, direction and angle [degrees]
        mirror: list[(x, y, z)] | dict; point and normal, also as keys of these names
        name: str; name of the copy's region, or the prefix of its regions' names; default: the names of the
            mesh
        """
        return self._method("copy", options_of(options, keywords))

    def pattern(self, count, **keywords):
        """The mesh and its copies, each moved relative to the one before, as one mesh.

        translate: (x, y, z); vector from each copy to the next
        rotate: list[(x, y, z) | float]; point, direction and angle [degrees]
        count: int; number of copies, including the mesh itself
        numbered: bool; each copy is a region: name_1, name_2 and so on; default False: all copies are one
            region
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
        """Coordinates x, y, z of all nodes."""
        return self._array("coordinates")

    def cells(self, kind=None):
        """Node numbers of all cells of a kind, from 1; for order 2 including the mid-side nodes, in VTK's
        order.

        kind: default "hex"
        """
        return self._array("cells", kind)

    def field(self, metric=None, kind=None):
        """A metric of every cell of a kind, in the order of `cells(kind)`.

        metric: default "scaled_jacobian"; for cells other than hexahedra "scaled_jacobian", "jacobian" or
            "volume"
        kind: default "hex"
        """
        return self._array("field", metric, kind)

    def write(self, path, options=None, /, **keywords):
        """Write the mesh to a file. The extension sets the format.

        path: .msh, .vtu, .pvtu, .vtk, .inp, .bdf, .nas, .dat, .unv, .exo, .e, .k, .feb, .med, or a folder
            called polyMesh
        version: float
        binary: bool
        quality: bool | str | list[str]; metrics of every cell that are written, as $ElementData or cell
            arrays; True: the scaled Jacobian; default True, but False for version 2.2
        with_: Model | list[Model]; models loaded from finite element meshes, to which the mesh is joined; the
            volume's own model first
        without: str | int | list[str | int]; regions, properties, sets or parts of these models that are not
            written
        renumber: bool; numbers and names that occur in several decks are changed; default False
        first_node: int; number of the mesh's first node, in decks and with a model; default above all numbers
            in use
        first_cell: int; number of the mesh's first element, likewise
        element: str; Abaqus element type of the hexahedra in .inp; default "C3D8", of order 2 "C3D20"; for
            thin layers: "COH3D8", "GK3D8", "SC8R", "CSS8"
        groups: "one" | "all"; .msh: each cell is written in one physical group, or in all of its groups,
            which then overlap; default "one"
        gmsh_options: bool; .msh: also write a file with .opt appended to its name, with Gmsh's display
            options for cells and groups; default False
        interfaces: bool; assembly: the quads between volumes are written as elements too; default False
        orientation: bool; write the directions of the cells: as fields in .vtu, .vtk and .exo, as material
            axes in .inp, .bdf and .feb; default False
        partitions: int | "processes"; .pvtu and .msh: number of parts; for .pvtu the default is the number of
            processes
        ghosts: int; number of rows of neighbouring parts' cells that each part has as ghost cells; default 0
        """
        self._method("write", path, options_of(options, keywords))

    def view(self, path, options=None, /, **keywords):
        """Write an HTML page with the mesh, to rotate, cut and colour it.

        path: .html
        title: str; title of the page; default: the name of the input
        """
        self._method("view", path, options_of(options, keywords))

    def picture(self, path, options=None, /, **keywords):
        """Write a picture. No display is needed.

        path: .png
        width: int; default 1200 [pixels]
        height: int; default 900 [pixels]
        view: (x, y, z) | "iso" | "front" | "back" | "left" | "right" | "top" | "bottom"; direction from the
            object to the viewer; default "iso"
        colour: "quality" | "layer" | "groups" | "region" | "origin"; what the colours of cells show; default
            "quality"
        cut: list[(x, y, z)] | dict; point and normal, also as keys of these names: only cells whose centre
            lies behind this plane are shown
        layers: list[int]; first and last layer that is shown; default all
        edges: bool; draw the edges of the cells; default True
        legend: bool; show a title and a key to the colours; default True
        title: str; default: the name of the mesh, its numbers of nodes and cells
        """
        self._method("picture", path, options_of(options, keywords))


class Assembly(Object):
    """Several volumes that are meshed together."""

    __slots__ = ()

    def contacts(self, options=None, /, **keywords):
        """Volumes whose faces touch or face each other without common nodes.

        gap: float; largest distance between the faces; default 0: only faces that touch [model length]
        """
        return shaped(self._method("contacts", options_of(options, keywords)), ('list', ('of', 'Contact')))

    def sweep(self, options=None, /, **keywords):
        """Mesh the volumes. The options apply to all volumes; `[volume] = options` replaces them for one.

        layers: int | list[float] | dict; a count, increasing heights in (0, 1] or a spacing; default: the
            rows of the walls' given meshes, otherwise layers about as high as the quads are wide
        size: float | Callable[[float, float, float], float]; edge length on the source; default: that of the
            source's boundary
        curvature: int; least number of edges per full circle where curves and surfaces bend; default 12; 0:
            only the size counts
        gap: int; least number of quads across narrow parts of the source; default: none, 3 where there is no
            size
        max_deviation: float; largest distance of the mesh's boundary from the volume's [model length];
            default: a quarter of a quad's edge
        quads: "auto" | "paved" | "mapped" | "gmsh" | "keep"; how faces are meshed; default "auto"; the report
            names the method for each face
        fallback: "none" | "wedges" | "leave_out" | "mixed"; what to do with a volume that cannot be meshed
            with hexahedra only; default: an error
        wedges: bool; triangles of an end's given mesh are kept, and wedges swept from them; default False: an
            end with both triangles and quads is an error
        rows: int; rows of quads along every loop of the source that are not moved afterwards; default: chosen
            by the paving method
        row_height: float | Callable[[float, float, float], float]; height of these rows, of which there is at
            least one; default: the size
        boundary_layers: dict | list[dict]; rows of thin cells along walls and ends
        intervals: list[list[Any]]; numbers of edges on curves, walls and along the sweep
        periodic: list[list[Any]]; pairs of faces with the same mesh, up to a translation or rotation
        order: 1 | 2; 1: hex8; 2: hex27, with the mid-side and mid-face nodes on the curves and surfaces;
            default 1
        serendipity: bool; with order 2: hex20 instead of hex27; default False
        min_scaled_jacobian: float; a mesh with a smaller value is an error; default 0
        improve: bool | dict; optimise the positions of nodes; `iterations` of each optimisation, 60; default
            True
        threads: int; default: all cores
        contacts: dict; ties and contacts of faces without common nodes

        A dict for `layers` has:
        count: int
        bias: float; ratio of layer heights: last to first (geometric), middle to end (bell), end to middle
            (both_ends)
        mode: "geometric" | "bell" | "both_ends"; default "geometric"

        A dict for `boundary_layers` has:
        walls: Face | int | str | dict | list[Face | int | str | dict]; walls or ends; "walls": all walls,
            "void:<n>": a generated face
        first: float; thickness of the first row of cells, normal to the face [model length]
        growth: float; ratio of the thicknesses of successive rows; default 1
        count: int; number of rows; default 1

        One of `intervals`: Where the interval applies, its number of edges, and the ratio of the last edge
        length to the first (default 1). It applies to an edge by its tag, to two vertices by their tags, to a
        wall by its Face, name or selector, or to the layers with "sweep".

        A dict for `periodic` has:
        [1]: Face | int | str | dict | list[Face | int | str | dict]
        [2]: Face | int | str | dict | list[Face | int | str | dict]
        translate: (x, y, z)
        rotate: list[(x, y, z) | float]; point, direction, degrees

        A dict for `contacts` has:
        gap: float; gap of pairs that are not in `pairs`; default 0 [model length]
        type: "tie" | "contact"; type of pairs that are not in `pairs`; default "tie"
        pairs: list[dict]; pairs with their own gap, type or name
        """
        return self._method("sweep", options_of(options, keywords))

    def sweep_to(self, path, options=None, /, **keywords):
        """Sweep and write one layer at a time, as Volume.sweep_to does.

        layers: int | list[float] | dict; a count, increasing heights in (0, 1] or a spacing; default: the
            rows of the walls' given meshes, otherwise layers about as high as the quads are wide
        size: float | Callable[[float, float, float], float]; edge length on the source; default: that of the
            source's boundary
        curvature: int; least number of edges per full circle where curves and surfaces bend; default 12; 0:
            only the size counts
        gap: int; least number of quads across narrow parts of the source; default: none, 3 where there is no
            size
        max_deviation: float; largest distance of the mesh's boundary from the volume's [model length];
            default: a quarter of a quad's edge
        quads: "auto" | "paved" | "mapped" | "gmsh" | "keep"; how faces are meshed; default "auto"; the report
            names the method for each face
        fallback: "none" | "wedges" | "leave_out" | "mixed"; what to do with a volume that cannot be meshed
            with hexahedra only; default: an error
        wedges: bool; triangles of an end's given mesh are kept, and wedges swept from them; default False: an
            end with both triangles and quads is an error
        rows: int; rows of quads along every loop of the source that are not moved afterwards; default: chosen
            by the paving method
        row_height: float | Callable[[float, float, float], float]; height of these rows, of which there is at
            least one; default: the size
        boundary_layers: dict | list[dict]; rows of thin cells along walls and ends
        intervals: list[list[Any]]; numbers of edges on curves, walls and along the sweep
        periodic: list[list[Any]]; pairs of faces with the same mesh, up to a translation or rotation
        order: 1 | 2; 1: hex8; 2: hex27, with the mid-side and mid-face nodes on the curves and surfaces;
            default 1
        serendipity: bool; with order 2: hex20 instead of hex27; default False
        min_scaled_jacobian: float; a mesh with a smaller value is an error; default 0
        improve: bool | dict; optimise the positions of nodes; `iterations` of each optimisation, 60; default
            True
        threads: int; default: all cores
        write: dict; options of the file, as of mesh.write

        A dict for `layers` has:
        count: int
        bias: float; ratio of layer heights: last to first (geometric), middle to end (bell), end to middle
            (both_ends)
        mode: "geometric" | "bell" | "both_ends"; default "geometric"

        A dict for `boundary_layers` has:
        walls: Face | int | str | dict | list[Face | int | str | dict]; walls or ends; "walls": all walls,
            "void:<n>": a generated face
        first: float; thickness of the first row of cells, normal to the face [model length]
        growth: float; ratio of the thicknesses of successive rows; default 1
        count: int; number of rows; default 1

        One of `intervals`: Where the interval applies, its number of edges, and the ratio of the last edge
        length to the first (default 1). It applies to an edge by its tag, to two vertices by their tags, to a
        wall by its Face, name or selector, or to the layers with "sweep".

        A dict for `periodic` has:
        [1]: Face | int | str | dict | list[Face | int | str | dict]
        [2]: Face | int | str | dict | list[Face | int | str | dict]
        translate: (x, y, z)
        rotate: list[(x, y, z) | float]; point, direction, degrees
        """
        return self._method("sweep_to", path, options_of(options, keywords))


class AssemblyMesh(AnyMesh):
    """The mesh of an assembly, with one region for each volume."""

    __slots__ = ()

    @property
    def contacts(self):
        """ties and contacts between volumes"""
        return shaped(self._field("contacts"), ('list', ('of', 'Contact')))

    @property
    def interface_cells(self):
        """number of cells with zero thickness, made by `lacuna.split_interface`"""
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
        """Groups of quads and cells, as they are written to files. The cells of each volume are a group."""
        return self._method("groups")

    def copy(self, options=None, /, **keywords):
        """A translated, rotated or mirrored copy. In a mirrored copy the node order of each cell is reversed,
        so that the cells stay positive.

        translate: (x, y, z)
        rotate: list[(x, y, z) | float]; point, direction and angle [degrees]
        mirror: list[(x, y, z)] | dict; point and normal, also as keys of these names
        name: str; name of the copy's region, or the prefix of its regions' names; default: the names of the
            mesh
        """
        return self._method("copy", options_of(options, keywords))

    def pattern(self, count, **keywords):
        """The mesh and its copies, each moved relative to the one before, as one mesh.

        translate: (x, y, z); vector from each copy to the next
        rotate: list[(x, y, z) | float]; point, direction and angle [degrees]
        count: int; number of copies, including the mesh itself
        numbered: bool; each copy is a region: name_1, name_2 and so on; default False: all copies are one
            region
        """
        return self._method("pattern", options_of(None, keywords, count=count))

    def node(self, i):
        """Coordinates of a node."""
        return self._method("node", i)

    def hex(self, i):
        """Eight node numbers, Gmsh order."""
        return self._method("hex", i)

    def coordinates(self):
        """Coordinates x, y, z of all nodes."""
        return self._array("coordinates")

    def cells(self, kind=None):
        """Node numbers of all cells of a kind, from 1; for order 2 including the mid-side nodes, in VTK's
        order.

        kind: default "hex"
        """
        return self._array("cells", kind)

    def field(self, metric=None, kind=None):
        """A metric of every cell of a kind, in the order of `cells(kind)`. Of cells of order 2 only the
        corners are used.

        metric: default "scaled_jacobian"; for cells other than hexahedra "scaled_jacobian", "jacobian" or
            "volume"
        kind: default "hex"
        """
        return self._array("field", metric, kind)

    def wedge(self, i):
        """Six node numbers, Gmsh order."""
        return self._method("wedge", i)

    def pyramid(self, i):
        """Node numbers of the four base corners and of the apex."""
        return self._method("pyramid", i)

    def tet(self, i):
        """Four node numbers, Gmsh order."""
        return self._method("tet", i)

    def write(self, path, options=None, /, **keywords):
        """Write the mesh to a file. The extension sets the format.

        version: float
        binary: bool
        with_: Model | list[Model]; models loaded from finite element meshes, to which the mesh is joined; the
            volume's own model first
        without: str | int | list[str | int]; regions, properties, sets or parts of these models that are not
            written
        renumber: bool; numbers and names that occur in several decks are changed; default False
        first_node: int; number of the mesh's first node, in decks and with a model; default above all numbers
            in use
        first_cell: int; number of the mesh's first element, likewise
        element: str; Abaqus element type of the hexahedra in .inp; default "C3D8", of order 2 "C3D20"; for
            thin layers: "COH3D8", "GK3D8", "SC8R", "CSS8"
        groups: "one" | "all"; .msh: each cell is written in one physical group, or in all of its groups,
            which then overlap; default "one"
        gmsh_options: bool; .msh: also write a file with .opt appended to its name, with Gmsh's display
            options for cells and groups; default False
        interfaces: bool; assembly: the quads between volumes are written as elements too; default False
        orientation: bool; write the directions of the cells: as fields in .vtu, .vtk and .exo, as material
            axes in .inp, .bdf and .feb; default False
        partitions: int | "processes"; .pvtu and .msh: number of parts; for .pvtu the default is the number of
            processes
        ghosts: int; number of rows of neighbouring parts' cells that each part has as ghost cells; default 0
        """
        self._method("write", path, options_of(options, keywords))

    def view(self, path, options=None, /, **keywords):
        """Write an HTML page with the mesh, to rotate, cut and colour it, for example by region.

        path: .html
        title: str; title of the page; default: the name of the input
        """
        self._method("view", path, options_of(options, keywords))

    def picture(self, path, options=None, /, **keywords):
        """Write a picture. No display is needed.

        path: .png
        width: int; default 1200 [pixels]
        height: int; default 900 [pixels]
        view: (x, y, z) | "iso" | "front" | "back" | "left" | "right" | "top" | "bottom"; direction from the
            object to the viewer; default "iso"
        colour: "quality" | "layer" | "groups" | "region" | "origin"; what the colours of cells show; default
            "quality"
        cut: list[(x, y, z)] | dict; point and normal, also as keys of these names: only cells whose centre
            lies behind this plane are shown
        layers: list[int]; first and last layer that is shown; default all
        edges: bool; draw the edges of the cells; default True
        legend: bool; show a title and a key to the colours; default True
        title: str; default: the name of the mesh, its numbers of nodes and cells
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
        """triangles of the faces' given meshes"""
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
        """Scaled Jacobian at the corners, in the plane of each corner, and the areas of the quads and of the
        faces."""
        return self._method("quality")

    def groups(self):
        return self._method("groups")

    def node(self, i):
        return self._method("node", i)

    def quad(self, i):
        """Returns ... four numbers of nodes"""
        return self._method("quad", i)

    def model(self):
        """A model whose faces have these quads as their mesh, to sweep it."""
        return self._method("model")

    def coordinates(self):
        """Coordinates x, y, z of all nodes."""
        return self._array("coordinates")

    def cells(self, kind=None):
        """Node numbers of all cells of a kind, from 1.

        kind: default "quad"
        """
        return self._array("cells", kind)

    def write(self, path, options=None, /, **keywords):
        """path: .msh, .vtu, .vtk, .inp, .bdf, .nas, .dat, .unv, .exo or .e
        version: float; version of .msh
        binary: bool
        groups: "one" | "all"; .msh: each quad is written in one of its groups, or in all of them
        gmsh_options: bool; .msh: also write a .opt file with Gmsh's display options
        """
        self._method("write", path, options_of(options, keywords))

    def view(self, path, options=None, /, **keywords):
        """path: .html
        title: str; title of the page; default: the name of the input
        """
        self._method("view", path, options_of(options, keywords))

    def picture(self, path, options=None, /, **keywords):
        """path: .png
        width: int; default 1200 [pixels]
        height: int; default 900 [pixels]
        facets: bool; draw the edges of the facets; default False
        legend: bool; show a title and a key to the colours; default True
        title: str; default: name and numbers of what is shown
        view: (x, y, z) | "iso" | "front" | "back" | "left" | "right" | "top" | "bottom"; direction from the
            object to the viewer; default "iso"
        """
        self._method("picture", path, options_of(options, keywords))


class Quality(Object):
    """Quality of a mesh. It prints as a table, with a histogram and one line for each metric."""

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
        """smallest scaled Jacobian of each kind of cell in the mesh"""
        return self._field("least")

    @property
    def min_scaled_jacobian(self):
        return self._field("min_scaled_jacobian")

    @property
    def mean_scaled_jacobian(self):
        return self._field("mean_scaled_jacobian")

    @property
    def inverted(self):
        """number of cells with a Jacobian of 0 or less at a corner"""
        return self._field("inverted")

    @property
    def uncertified(self):
        """number of cells whose Jacobian is not proven positive everywhere"""
        return self._field("uncertified")

    @property
    def certified(self):
        """whether the Jacobian of every cell is proven positive everywhere"""
        return self._field("certified")

    @property
    def worst(self):
        """at most ten cells, the worst first; of a swept mesh at most one from each column"""
        return shaped(self._field("worst"), ('list', ('of', 'WorstCell')))

    @property
    def histogram(self):
        """histogram of the scaled Jacobian, with twenty bins over [-1, 1]"""
        return self._field("histogram")

    @property
    def metrics(self):
        """in order and by name; computed when first read"""
        return shaped(self._field("metrics"), ('rows', ('of', 'MetricSummary')))

    @property
    def volume(self):
        """[model length³]"""
        return self._field("volume")


def load(path, options=None, /, **keywords):
    """Read the faces of a file, or of several files as one model: CAD (.step .stp .iges .igs .brep .geo),
    facets (.stl .obj), meshes and decks (.msh .inp .bdf .nas .dat .unv .vtk .vtu .exo .e .mesh). In the place
    of a path: a mesh of meshio or PyVista.

    tolerance: float; gaps narrower than this are closed [model length]; default 1e-6 × the diagonal, more
        where coordinates are rounded
    feature_angle: float; facets are divided into faces along edges with at least this angle [degrees];
        default 40
    keep_mesh: bool; quads and nodes of the input are kept as a mesh; default True
    keep_noise: bool; points of noisy facets, for example from a scan, are not moved; default False: they are
        smoothed
    scale: float; factor of all coordinates; default 1
    unit: "um" | "mm" | "cm" | "m" | "in" | "ft"; declared unit of the model's lengths; STEP and IGES are
        converted to it
    cad_seconds: float; limit of the processor time of the CAD process [s]; in the sandbox it can only lower
        the limit
    cad_megabytes: float; limit of the address space of the CAD process [MB]; in the sandbox it can only lower
        the limit
    without: str | int | list[str | int]; regions, properties, sets or parts that are not read from meshes
    """
    return loaded(path, options_of(options, keywords))


def model(options=None, /, **keywords):
    """An empty model, to which faces can be added.

    tolerance: float; points closer than this are merged [model length]; default 1e-6 × the diagonal of the
        bounding box
    """
    return call("module", "model", options_of(options, keywords))


def assembly(volumes):
    """Volumes that are meshed together, sharing nodes where they share faces. Meshes among them are kept."""
    return call("module", "assembly", volumes)


def split_interface(mesh, faces, **keywords):
    """Duplicate the nodes of faces between two regions or layers, and insert a cell of zero thickness at
    each.

    faces: str | int | list[str | int | list[str]]; "all", a group, or an array of groups and pairs of
        regions; in the mesh of one sweep also numbers of layers, each the number below a split
    element: str; Abaqus element type of the cells of order 1: "COH3D8", "GK3D8", or a type that begins with
        one of these, or "none"; default "COH3D8"
    name: str; region and group of the cells; default "interface"
    """
    return call("module", "split_interface", mesh, options_of(None, keywords, faces=faces))


def check(path):
    """Quality of the solid elements of a mesh or deck in any format that can be read. For a file without
    solid elements it is the quality of its quads, as QuadMesh:quality()."""
    return call("module", "check", path)


def convert(from_, to, options=None, /, **keywords):
    """Convert a mesh or deck to another format. The extension of `to` sets the format.

    to: .msh .vtu .vtk .inp .bdf .nas .dat .unv .exo .e .k .feb .med
    version: float; of .msh; default 4.1
    binary: bool; of .msh and .vtk; default True
    groups: "one" | "all"; of .msh; default "one"
    """
    return call("module", "convert", from_, to, options_of(options, keywords))


def view(file, path, options=None, /, **keywords):
    """Write an HTML page of a file: the cells of a mesh or deck with solid elements, otherwise the faces.

    file: in any format that can be read
    path: .html
    title: str; title of the page; default: the name of the input
    show: "auto" | "faces" | "cells"; default "auto": the cells of a mesh that has solid elements, otherwise
        the faces
    """
    return call("module", "view", file, path, options_of(options, keywords))


def picture(file, path, options=None, /, **keywords):
    """Draw a file: the cells of a mesh or deck with solid elements, otherwise the faces. No display is
    needed.

    file: in any format that can be read
    path: .png
    width: int; default 1200 [pixels]
    height: int; default 900 [pixels]
    view: (x, y, z) | "iso" | "front" | "back" | "left" | "right" | "top" | "bottom"; direction from the
        object to the viewer; default "iso"
    colour: "quality" | "layer" | "groups" | "region" | "origin"; what the colours of cells show; default
        "quality"
    cut: list[(x, y, z)] | dict; point and normal, also as keys of these names: only cells whose centre lies
        behind this plane are shown
    layers: list[int]; first and last layer that is shown; default all
    edges: bool; draw the edges of the cells; default True
    legend: bool; show a title and a key to the colours; default True
    title: str; default: the name of the mesh, its numbers of nodes and cells
    facets: bool; draw the edges of the facets; default False
    show: "auto" | "faces" | "cells"; default "auto": the cells of a mesh that has solids, otherwise the faces
    """
    return call("module", "picture", file, path, options_of(options, keywords))


classes.update(Contact=Contact, ModelInfo=ModelInfo, FaceInfo=FaceInfo, Cavity=Cavity,
               Classification=Classification, Match=Match, Closure=Closure, FreeEdge=FreeEdge,
               LeftOut=LeftOut, Fidelity=Fidelity, FaceFidelity=FaceFidelity,
               AssemblyFidelity=AssemblyFidelity, WorstCell=WorstCell, MetricSummary=MetricSummary,
               Model=Model, Face=Face, Volume=Volume, Mesh=Mesh, Assembly=Assembly, AssemblyMesh=AssemblyMesh,
               QuadMesh=QuadMesh, Quality=Quality)

for made in classes.values():
    made.__module__ = "lacuna"
