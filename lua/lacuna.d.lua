---@meta lacuna
-- SPDX-License-Identifier: MIT
-- The recipe language for the Lua language server: completion, hover and checking of recipes. Never run.
-- In .luarc.json: { "workspace.library": ["<folder of this file>"] }.

---@alias lacuna.Vector { [1]: number, [2]: number, [3]: number } x, y, z [model length]
---@alias lacuna.Plane { [1]: lacuna.Vector, [2]: lacuna.Vector }|{ point: lacuna.Vector, normal: lacuna.Vector } point and normal
---@alias lacuna.Thickness number|fun(x: number, y: number, z: number): number [model length]
---@alias lacuna.Class "I"|"II"|"III"|"IV"|"V"|"closed"|"0"

--- A face, its tag, its name, a selector, or an array of those.
---@alias lacuna.FaceRef lacuna.Face|integer|string|lacuna.Selector
---@alias lacuna.FaceRefs lacuna.FaceRef|lacuna.FaceRef[]

--- Selects the faces that meet every given condition.
---@class lacuna.Selector
---@field tags? integer|integer[]
---@field name? string name of a physical group, a part (`pid:7`) or an element set
---@field kind? "plane"|"cylinder"|"cone"|"sphere"|"torus"|"bspline"|"surface"|"discrete"
---@field facing? lacuna.Vector faces whose mean normal is within 30 degrees of this direction
---@field normal_within? number largest angle from `facing`, instead of 30 [degrees]
---@field near? lacuna.Vector the one face closest to this point
---@field within? number with `near`: all faces within this distance instead [model length]
---@field box? { [1]: lacuna.Vector, [2]: lacuna.Vector } two opposite corners of a box that contains the whole face
---@field touching? lacuna.Face|integer|string faces that share an edge with this one
---@field region? string faces that bound this solid, part or set
---@field free? boolean true: faces that bound exactly one region; false: faces between two regions
---@field radius? { [1]: number, [2]: number } smallest and largest radius, of faces that are parts of cylinders or spheres [model length]
---@field area? { [1]: number, [2]: number } smallest and largest area [model length²]

---@class lacuna.LoadOptions
---@field tolerance? number gaps narrower than this are closed [model length]; default 1e-6 × the diagonal, more where coordinates are rounded
---@field feature_angle? number facets are divided into faces along edges with at least this angle [degrees]; default 40
---@field keep_mesh? boolean quads and nodes of the input are kept as a mesh; default true
---@field keep_noise? boolean points of noisy facets, for example from a scan, are not moved; default false: they are smoothed
---@field scale? number factor of all coordinates; default 1
---@field unit? "um"|"mm"|"cm"|"m"|"in"|"ft" declared unit of the model's lengths; STEP and IGES are converted to it
---@field cad_seconds? number limit of the processor time of the CAD process [s]; in the sandbox it can only lower the limit
---@field cad_megabytes? number limit of the address space of the CAD process [MB]; in the sandbox it can only lower the limit
---@field without? string|integer|(string|integer)[] regions, properties, sets or parts that are not read from meshes

---@class lacuna.ModelOptions
---@field tolerance? number points closer than this are merged [model length]; default 1e-6 × the diagonal of the bounding box

---@class lacuna.FaceFromOptions
---@field near lacuna.Vector point next to the first facet of the face [model length]
---@field angle? number the face grows across edges where neighbouring facets form at most this angle [degrees]; default 20
---@field region? string grow only on faces that bound this region
---@field free? boolean true: grow only on faces that bound one region; false: only on faces that bound two

---@class lacuna.NewFace
---@field name? string
---@field points lacuna.Vector[]
---@field cells integer[][] triangles and quads, as numbers of points, from 1
---@field keep_mesh? boolean the quads are kept as a mesh; default false: they only describe the shape

---@class lacuna.Roles
---@field source? lacuna.FaceRefs
---@field target? lacuna.FaceRefs
---@field walls? lacuna.FaceRefs|"auto" "auto": in a solid the faces of the source's cavity, otherwise all faces connected to the boundary of the source
---@field faces? lacuna.FaceRefs instead of roles: the faces of the volume; their roles are detected
---@field reading? integer where roles are detected and several volumes are possible: number of the volume, from 1
---@field full_turn? boolean the walls form a closed ring, swept through 360 degrees without ends; default false
---@field along? lacuna.Along where only a source, and walls if any, are given: the path along which the source is swept
---@field fill_to? lacuna.Plane point and normal, also as keys of these names: only the part of the void behind this plane is filled
---@field class? lacuna.Class class to use instead of the detected one
---@field name? string name of the group, set or property of the cells in files; default "volume"
---@field material? string|integer material of the cells, in decks; default: that of the adjacent elements
---@field glued? boolean false: in an assembly the volume shares no nodes with the volumes it touches; ties connect them; default true

--- The path of a sweep: one of vector, axis, path, helix, normals and to.
---@class lacuna.Along
---@field vector? lacuna.Vector translation
---@field axis? { [1]: lacuna.Vector, [2]: lacuna.Vector } point and direction of the axis of a rotation by `angle`
---@field angle? number angle of the rotation about `axis`, from -360 to 360 [degrees]
---@field path? lacuna.Vector[]|integer[]|fun(t: number): lacuna.Vector points with corners, tags of edges, or a smooth curve for t from 0 to 1
---@field frame? "minimal"|"fixed" with `path`: "minimal": the source rotates with the path's direction, without twist; "fixed": it does not rotate; default "minimal"
---@field helix? { [1]: lacuna.Vector, [2]: lacuna.Vector, [3]: number, [4]: number } point, direction, pitch and turns; negative turns: left-handed
---@field normals? lacuna.Thickness|{ [1]: lacuna.Thickness, [2]: lacuna.Thickness } thickness along the source's normals, or { inside, outside }
---@field to? lacuna.FaceRef the source is projected along its mean normal onto this face
---@field twist? number|fun(height: number): number rotation of the target, or of the section at each height from 0 to 1 [degrees]
---@field scale? number|fun(height: number): number scale of the target, or of the section at each height from 0 to 1

---@class lacuna.QuadsOptions
---@field faces? lacuna.FaceRefs default: all
---@field size? number|fun(x: number, y: number, z: number): number edge length; default: that of the faces' boundaries
---@field curvature? integer least number of edges per full circle where curves and surfaces bend; default 12; 0: only the size counts
---@field gap? integer least number of quads across narrow parts; default: none, 3 where there is no size
---@field quads? "auto"|"paved"|"mapped"|"gmsh"|"keep" how faces are meshed; default "auto"; the report names the method for each face
---@field order? 1|2 1: quads of 4 nodes; 2: of 9 nodes, with the mid-side nodes on the curves and surfaces; default 1
---@field serendipity? boolean with order 2: quads of 8 nodes; default false
---@field threads? integer default: all cores

---@class lacuna.QuadsWriteOptions
---@field version? 4.1|2.2 version of .msh
---@field binary? boolean
---@field groups? "one"|"all" .msh: each quad is written in one of its groups, or in all of them
---@field gmsh_options? boolean .msh: also write a .opt file with Gmsh's display options

--- Exactly one of translate, rotate and mirror.
---@class lacuna.CopyOptions
---@field translate? lacuna.Vector
---@field rotate? { [1]: lacuna.Vector, [2]: lacuna.Vector, [3]: number } point, direction and angle [degrees]
---@field mirror? lacuna.Plane point and normal, also as keys of these names
---@field name? string name of the copy's region, or the prefix of its regions' names; default: the names of the mesh

--- One of translate and rotate, and the number of copies.
---@class lacuna.PatternOptions
---@field translate? lacuna.Vector vector from each copy to the next
---@field rotate? { [1]: lacuna.Vector, [2]: lacuna.Vector, [3]: number } point, direction and angle [degrees]
---@field count integer number of copies, including the mesh itself
---@field numbered? boolean each copy is a region: name_1, name_2 and so on; default false: all copies are one region

---@class lacuna.MatchOptions
---@field vertices? { [1]: integer, [2]: integer }[] pairs of vertex tags: source, target
---@field loops? { [1]: integer, [2]: integer }[] pairs of loop numbers: source, target
---@field flip? integer[] numbers of source loops whose direction on the target is reversed
---@field method? "aligned"|"nearest" default "aligned"

---@class lacuna.CloseOptions
---@field edge_shape? "auto"|"straight"|"follow"|"smooth" shape of the missing edges; default "auto"
---@field void_edges? { [1]: integer, [2]: integer, [3]?: lacuna.Vector[] }[] edges given by the user: tags of the first and last vertex, points between them
---@field cap? "auto"|"flat"|"parallel" shape of a missing end; default "auto"
---@field holes? "cover"|"through" holes of a given end without walls: cover them, or continue them through the volume; required where the other end is missing

---@class lacuna.Layers
---@field count integer
---@field bias? number ratio of layer heights: last to first (geometric), middle to end (bell), end to middle (both_ends)
---@field mode? "geometric"|"bell"|"both_ends" default "geometric"

---@class lacuna.BoundaryLayer
---@field walls lacuna.FaceRefs walls or ends; "walls": all walls, "void:<n>": a generated face
---@field first number thickness of the first row of cells, normal to the face [model length]
---@field growth? number ratio of the thicknesses of successive rows; default 1
---@field count? integer number of rows; default 1

--- Where the interval applies, its number of edges, and the ratio of the last edge length to the first
--- (default 1). It applies to an edge by its tag, to two vertices by their tags, to a wall by its Face, name
--- or selector, or to the layers with "sweep".
---@class lacuna.Interval
---@field [1] integer|{ [1]: integer, [2]: integer }|lacuna.FaceRefs|"sweep"
---@field [2] integer
---@field [3]? number

--- Two faces, or groups of faces, with the same mesh, and the rigid motion from the first to the second.
--- Default: the detected translation, otherwise the detected rotation with the smallest angle.
---@class lacuna.PeriodicPair
---@field [1] lacuna.FaceRefs
---@field [2] lacuna.FaceRefs
---@field translate? lacuna.Vector
---@field rotate? { [1]: lacuna.Vector, [2]: lacuna.Vector, [3]: number } point, direction, degrees

--- Two bodies whose faces touch or face each other.
---@class lacuna.Contact
---@field a string region
---@field b string region
---@field name? string name of the pair; default: a_b
---@field type? "tie"|"contact" default "tie"
---@field gap? number largest distance of the faces [model length]
---@field faces? { [1]: integer, [2]: integer }[] pairs of tags of the faces in contact
---@field least? number smallest distance between the faces [model length]
---@field width? number largest distance between the faces [model length]
---@field area? number area of the faces of `a` that are within the gap [model length²]
---@field slave? string name of the slave group in a mesh
---@field master? string name of the master group in a mesh

---@class lacuna.ContactsOptions
---@field gap? number largest distance between the faces; default 0: only faces that touch [model length]

---@class lacuna.ContactRequest
---@field gap? number gap of pairs that are not in `pairs`; default 0 [model length]
---@field type? "tie"|"contact" type of pairs that are not in `pairs`; default "tie"
---@field pairs? lacuna.Contact[] pairs with their own gap, type or name

---@class lacuna.SweepOptions
---@field layers? integer|number[]|lacuna.Layers a count, increasing heights in (0, 1] or a spacing; default: the
---rows of the walls' given meshes, otherwise layers about as high as the quads are wide
---@field size? number|fun(x: number, y: number, z: number): number edge length on the source; default: that of the source's boundary
---@field curvature? integer least number of edges per full circle where curves and surfaces bend; default 12; 0: only the size counts
---@field gap? integer least number of quads across narrow parts of the source; default: none, 3 where there is no size
---@field max_deviation? number largest distance of the mesh's boundary from the volume's [model length]; default: a quarter of a quad's edge
---@field quads? "auto"|"paved"|"mapped"|"gmsh"|"keep" how faces are meshed; default "auto"; the report names the method for each face
---@field fallback? "none"|"wedges"|"leave_out"|"mixed" what to do with a volume that cannot be meshed with hexahedra only; default: an error
---@field wedges? boolean triangles of an end's given mesh are kept, and wedges swept from them; default false: an end with both triangles and quads is an error
---@field rows? integer rows of quads along every loop of the source that are not moved afterwards; default: chosen by the paving method
---@field row_height? number|fun(x: number, y: number, z: number): number height of these rows, of which there is at least one; default: the size
---@field boundary_layers? lacuna.BoundaryLayer|lacuna.BoundaryLayer[] rows of thin cells along walls and ends
---@field intervals? lacuna.Interval[] numbers of edges on curves, walls and along the sweep
---@field periodic? lacuna.PeriodicPair[] pairs of faces with the same mesh, up to a translation or rotation
---@field order? 1|2 1: hex8; 2: hex27, with the mid-side and mid-face nodes on the curves and surfaces; default 1
---@field serendipity? boolean with order 2: hex20 instead of hex27; default false
---@field min_scaled_jacobian? number a mesh with a smaller value is an error; default 0
---@field improve? boolean|{ iterations?: integer, seconds?: number } optimise the positions of nodes; `iterations` of each optimisation, 60; default true
---@field threads? integer default: all cores

---@class lacuna.SweepToOptions: lacuna.SweepOptions
---@field write? { version?: 4.1|2.2, binary?: boolean, quality?: boolean|lacuna.MetricName|lacuna.MetricName[], partitions?: integer|"processes", ghosts?: integer, interfaces?: boolean, groups?: "one"|"all", gmsh_options?: boolean } options of the file, as of mesh:write

---@class lacuna.WriteOptions
---@field version? 4.1|2.2
---@field binary? boolean
---@field quality? boolean|lacuna.MetricName|lacuna.MetricName[] metrics of every cell that are written, as $ElementData or cell arrays; true: the scaled Jacobian; default true, but false for version 2.2
---@field with? lacuna.Model|lacuna.Model[] models loaded from finite element meshes, to which the mesh is joined; the volume's own model first
---@field without? string|integer|(string|integer)[] regions, properties, sets or parts of these models that are not written
---@field renumber? boolean numbers and names that occur in several decks are changed; default false
---@field first_node? integer number of the mesh's first node, in decks and with a model; default above all numbers in use
---@field first_cell? integer number of the mesh's first element, likewise
---@field element? string Abaqus element type of the hexahedra in .inp; default "C3D8", of order 2 "C3D20"; for thin layers: "COH3D8", "GK3D8", "SC8R", "CSS8"
---@field groups? "one"|"all" .msh: each cell is written in one physical group, or in all of its groups, which then overlap; default "one"
---@field gmsh_options? boolean .msh: also write a file with .opt appended to its name, with Gmsh's display options for cells and groups; default false
---@field interfaces? boolean assembly: the quads between volumes are written as elements too; default false
---@field orientation? boolean write the directions of the cells: as fields in .vtu, .vtk and .exo, as material axes in .inp, .bdf and .feb; default false
---@field partitions? integer|"processes" .pvtu and .msh: number of parts; for .pvtu the default is the number of processes
---@field ghosts? integer number of rows of neighbouring parts' cells that each part has as ghost cells; default 0

---@class lacuna.ConvertOptions
---@field version? 4.1|2.2 of .msh; default 4.1
---@field binary? boolean of .msh and .vtk; default true
---@field groups? "one"|"all" of .msh; default "one"

---@class lacuna.PageOptions
---@field title? string title of the page; default: the name of the input

---@class lacuna.ViewOptions: lacuna.PageOptions
---@field show? "auto"|"faces"|"cells" default "auto": the cells of a mesh that has solid elements, otherwise the faces

--- Options of a picture of a model, volume or mesh of quads.
---@class lacuna.FacePictureOptions
---@field width? integer default 1200 [pixels]
---@field height? integer default 900 [pixels]
---@field facets? boolean draw the edges of the facets; default false
---@field legend? boolean show a title and a key to the colours; default true
---@field title? string default: name and numbers of what is shown
---@field view? "iso"|"front"|"back"|"left"|"right"|"top"|"bottom"|lacuna.Vector direction from the object to the viewer; default "iso"

---@class lacuna.PictureOptions
---@field width? integer default 1200 [pixels]
---@field height? integer default 900 [pixels]
---@field view? "iso"|"front"|"back"|"left"|"right"|"top"|"bottom"|lacuna.Vector direction from the object to the viewer; default "iso"
---@field colour? "quality"|"layer"|"groups"|"region"|"origin" what the colours of cells show; default "quality"
---@field cut? lacuna.Plane point and normal, also as keys of these names: only cells whose centre lies behind this plane are shown
---@field layers? { [1]: integer, [2]: integer } first and last layer that is shown; default all
---@field edges? boolean draw the edges of the cells; default true
---@field legend? boolean show a title and a key to the colours; default true
---@field title? string default: the name of the mesh, its numbers of nodes and cells

--- Options of a picture of a file. `facets` is for faces; `colour`, `cut`, `layers` and `edges` for cells.
---@class lacuna.FileOptions: lacuna.PictureOptions
---@field facets? boolean draw the edges of the facets; default false
---@field show? "auto"|"faces"|"cells" default "auto": the cells of a mesh that has solids, otherwise the faces

---@class lacuna.Classification
---@field class lacuna.Class
---@field free_loops integer number of closed loops of free edges
---@field wall_free_source integer[] tags of the source's vertices that lie on no wall
---@field wall_free_target integer[] tags of the target's vertices that lie on no wall
---@field reasons string[]

---@class lacuna.Match
---@field loops { source: integer, target: integer, flipped: boolean }[]
---@field vertices { [1]: integer, [2]: integer }[] pairs of vertex tags: source, target
---@field method string
---@field confidence number from 0 to 1; 1 where nothing had to be guessed
---@field notes string[]

---@class lacuna.Closure
---@field void_edges integer number of generated edges
---@field void_faces integer number of generated faces
---@field void_edge_tags integer[]
---@field void_face_tags integer[]
---@field watertight boolean
---@field algorithms string[] names of the paper's algorithms, in the order used

---@class lacuna.FreeEdge
---@field tag integer
---@field from integer tag of the first vertex
---@field to integer tag of the last vertex
---@field length number [model length]

---@class lacuna.WorstCell
---@field cell integer
---@field layer? integer
---@field centre lacuna.Vector
---@field scaled_jacobian number

--- Verdict's metrics of hexahedra, as VTK computes them. `scaled_jacobian` is the smallest value at the
--- corners; `scaled_jacobian_with_centre` includes the centre, as Verdict does. `edge_ratio` is VTK's, which
--- does not examine all edges; `full_edge_ratio` compares all twelve. `volume` is the value of VTK and Cubit,
--- computed from the Jacobian at the centre; `Quality.volume` is exact.
---@alias lacuna.MetricName
---| "scaled_jacobian" | "scaled_jacobian_with_centre" | "jacobian" | "shape" | "shear" | "condition"
---| "max_aspect_frobenius" | "med_aspect_frobenius" | "oddy" | "skew" | "taper" | "max_edge_ratio" | "edge_ratio"
---| "full_edge_ratio" | "stretch" | "diagonal" | "dimension" | "volume" | "distortion" | "relative_size_squared"
---| "shape_and_size" | "shear_and_size"

---@class lacuna.MetricSummary
---@field name lacuna.MetricName
---@field cells integer number of cells for which the metric is defined
---@field min number
---@field mean number
---@field max number
---@field deviation number standard deviation
---@field acceptable? { [1]: number, [2]: number } acceptable range according to Cubit; nil where it depends on the application
---@field outside integer number of cells outside the acceptable range
---@field outside_share number fraction of the cells outside the acceptable range, 0 to 1
---@field worst { cell: integer, layer?: integer, centre: lacuna.Vector, value: number }

--- Quality of a mesh. It prints as a table, with a histogram and one line for each metric.
---@class lacuna.Quality
---@field hexes integer
---@field wedges integer
---@field pyramids integer
---@field tets integer
---@field least { hexes?: number, wedges?: number, pyramids?: number, tets?: number } smallest scaled Jacobian of each kind of cell in the mesh
---@field min_scaled_jacobian number
---@field mean_scaled_jacobian number
---@field inverted integer number of cells with a Jacobian of 0 or less at a corner
---@field uncertified integer number of cells whose Jacobian is not proven positive everywhere
---@field certified boolean whether the Jacobian of every cell is proven positive everywhere
---@field worst lacuna.WorstCell[] at most ten cells, the worst first; of a swept mesh at most one from each column
---@field histogram integer[] histogram of the scaled Jacobian, with twenty bins over [-1, 1]
---@field metrics table<integer|lacuna.MetricName, lacuna.MetricSummary> in order and by name; computed when first read
---@field volume number [model length³]

---@class lacuna.Face
---@field tag integer the tag that Gmsh gives the face when it opens the same file
---@field name string
---@field kind string
---@field area number [model length²]
---@field normal lacuna.Vector mean unit normal; zero for a closed tube
---@field centroid lacuna.Vector
---@field loops integer number of boundary loops
---@field edges integer
---@field has_mesh boolean
---@field radius? number radius of the cylinder or sphere fitted to its facets [model length]
---@field axis? lacuna.Vector direction of the axis of this cylinder
---@field box { [1]: lacuna.Vector, [2]: lacuna.Vector } bounding box: the smallest and the largest coordinates
---@field neighbours integer[] tags of faces that share an edge with it

---@class lacuna.Cavity
---@field kind "pocket"|"bore"|"slot"|"inner void"
---@field faces integer[] tags, for open_volume{ faces = … }; with those of the bodies in it
---@field class lacuna.Class
---@field volume number volume of the sealed cavity [model length³]

---@class lacuna.FaceInfo: lacuna.Face
---@field fits? "cylinder"|"sphere"|"cone" surface fitted to its facets
---@field centre? lacuna.Vector centre of this cylinder or sphere
---@field apex? lacuna.Vector apex of this cone; `axis` points from it into the cone
---@field half_angle? number angle between axis and surface of this cone [degrees]
---@field least_radius? number smallest radius of the face on this cone [model length]
---@field largest_radius? number largest radius of the face on this cone [model length]
---@field free_edges integer number of free edges
---@field part integer number of the connected component of faces
---@field cavity? integer index in `cavities`
---@field use string the kind of its cavity, "outer skin" or "open shell"

---@class lacuna.ModelInfo
---@field source string
---@field diagonal number [model length]
---@field tolerance number [model length]
---@field parts integer number of connected components of the faces
---@field closed_parts integer number of components without free edges
---@field faces lacuna.FaceInfo[]
---@field free_edges { tag: integer, face: integer, from: integer, to: integer, length: number }[]
---@field gaps { edge: integer, other: integer, width: number, tolerance: number }[] `tolerance`: the smallest that closes the gap
---@field cavities lacuna.Cavity[]

---@class lacuna.Model
---@field tolerance number [model length]
---@field diagonal number [model length]
---@field regions string[] names of the closed bodies, in the order of `bodies()`
local Model = {}
--- The faces that the selector selects; without one, all faces.
---@param selector? lacuna.Selector|string|integer
---@return lacuna.Face[]
function Model:faces(selector) end
--- The one face that `which` selects. If it selects none or several, the error lists the candidates.
---@param which lacuna.FaceRef
---@return lacuna.Face
function Model:face(which) end
--- Make a face of the facets around a point. They are removed from the faces they belonged to.
---@param options lacuna.FaceFromOptions
---@return lacuna.Face
function Model:face_from(options) end
--- Add a face of triangles and quads to the model. Points are numbered from 1.
---@param face lacuna.NewFace
---@return lacuna.Face
function Model:add_face(face) end
--- The volume bounded by the faces with the given roles. Without roles, the roles of `faces`, or of all
--- faces, are detected.
---@param roles? lacuna.Roles
---@return lacuna.Volume
function Model:open_volume(roles) end
--- Quads on faces, without layers.
---@param options? lacuna.QuadsOptions
---@return lacuna.QuadMesh
function Model:quads(options) end
--- A volume for each closed body: the solids of CAD, the regions of meshes, or else the closed parts.
---@return lacuna.Volume[]
function Model:bodies() end
--- Bodies whose faces touch or face each other.
---@param options? lacuna.ContactsOptions
---@return lacuna.Contact[]
function Model:contacts(options) end
--- Faces, free edges, gaps and cavities, as text.
---@return string
function Model:describe() end
--- The information of `describe`, as a table.
---@return lacuna.ModelInfo
function Model:info() end
--- Pockets, bores, slots and inner voids of closed surfaces.
---@return lacuna.Cavity[]
function Model:cavities() end
--- Write an HTML page with the labelled faces; clicking on them sets the roles for a recipe.
---@param path string .html
---@param options? lacuna.PageOptions
function Model:view(path, options) end
--- Write a picture of the faces and their free edges. No display is needed.
---@param path string .png
---@param options? lacuna.FacePictureOptions
function Model:picture(path, options) end

---@class lacuna.CutOptions
---@field plane? lacuna.Plane point and normal, also as keys of these names
---@field face? lacuna.FaceRef a Face of any model, or a face of the volume
---@field auto? boolean cut where the pieces can be swept: along planes at concave edges, or into blocks at the vertices

---@class lacuna.Volume
---@field class lacuna.Class class of the input, before `close`
local Volume = {}
--- The class of the volume, the reasons for it, and what is missing.
---@return lacuna.Classification
function Volume:classify() end
--- Set the class of the volume. It is an error if the faces contradict the class.
---@param class lacuna.Class
---@return lacuna.Volume self
function Volume:override_class(class) end
--- Pair the loops and vertices of source and target. `close` does this where it was not called.
---@param options? lacuna.MatchOptions
---@return lacuna.Match
function Volume:match(options) end
--- Generate the missing edges and faces; afterwards the volume is sealed. `sweep` does this where it was
--- not called.
---@param options? lacuna.CloseOptions
---@return lacuna.Closure
function Volume:close(options) end
--- Whether the volume's boundary is closed.
---@return boolean
function Volume:is_watertight() end
--- Edges with a face on only one side.
---@return lacuna.FreeEdge[]
function Volume:free_edges() end
--- Volume, faces, edges and vertices, with the geometry of each, as text. Generated ones are marked.
---@return string
function Volume:tree() end
--- Roles, class, missing faces and the pairs of vertices, as text.
---@return string
function Volume:describe() end
--- Write an HTML page with roles, generated faces, free edges and vertices on no wall.
---@param path string .html
---@param options? lacuna.PageOptions
function Volume:view(path, options) end
--- Write a picture of the given and the generated faces. No display is needed.
---@param path string .png
---@param options? lacuna.FacePictureOptions
function Volume:picture(path, options) end
--- Cut the volume by a plane or a face into pieces that share the cut. Without options a volume is cut
--- where it branches, or where an end lies at several heights; otherwise the result is the volume itself.
---@param options? lacuna.CutOptions
---@return lacuna.Volume[]
function Volume:cut(options) end
--- The volume's faces, including the generated ones, as a model.
---@return lacuna.Model
function Volume:model() end
--- Mesh the volume by sweeping. It is closed first where `close` was not called. A volume with steps is cut
--- into pieces that are meshed as an assembly.
---@param options lacuna.SweepOptions
---@return lacuna.Mesh|lacuna.AssemblyMesh
function Volume:sweep(options) end
--- Sweep and write one layer at a time; the memory needed hardly depends on the number of layers. The file
--- is the same as that of sweep(options):write(path). The report has nodes, hexes, wedges, layers,
--- min_scaled_jacobian, streamed, processes (with mpirun) and seconds by stage.
---@param path string .msh, .vtu, .pvtu, .vtk, .inp, .bdf, .nas, .dat, .unv, .exo, .e, .k or .feb
---@param options lacuna.SweepToOptions
---@return table report
function Volume:sweep_to(path, options) end
--- Write the facets of the sealed volume: a closed surface with outward normals.
---@param path string .stl, .msh or .obj
---@param options? { binary?: boolean, groups?: "one"|"all" } binary: .stl and .msh, default true; groups: .msh, default "one"
function Volume:write_facets(path, options) end
--- Write the sealed volume as one CAD solid: given CAD faces exactly, generated faces as planes or fitted
--- surfaces.
---@param path string .step, .stp or .brep
---@param options? { tolerance?: number, deviation?: number, cad_seconds?: number, cad_megabytes?: number } tolerance: largest gap that is closed [model length]; deviation: largest relative difference between the volume of the solid and of the facets (default 0.05)
---@return { volume: number, faces: integer, planes: integer, fitted: integer, tolerance: number }
function Volume:write_cad(path, options) end

---@class lacuna.FaceFidelity
---@field quads integer number of the mesh's boundary quads on the face
---@field max_distance number largest distance [model length]; of a face without quads, its width
---@field mean_distance number [model length]
---@field place lacuna.Vector point of the largest distance

--- How far the boundary of the mesh is from the boundary of the sealed volume.
---@class lacuna.Fidelity
---@field volume number volume of the cells [model length³]
---@field sealed_volume number [model length³]
---@field max_distance number [model length]
---@field mean_distance number [model length]
---@field faces table<integer|string, lacuna.FaceFidelity> by tag, generated faces by "void:<n>"

--- The error value of a failed call, as pcall returns it. It prints as its message, and has the methods of
--- strings.
---@class lacuna.Error
---@field message string what was expected, what was found, how to correct it
---@field code string code for programs, as "folder.what_went_wrong"; codes do not change
---@field entities { kind: string, tag: integer }[] faces, edges, nodes and so on that the message names
---@field found (number|string)[] values found in the input
---@field needed (number|string)[] values expected instead
---@field remedy? string the part of the message that says how to correct the error
---@field attempts { message: string, code: string, entities: { kind: string, tag: integer }[] }[] errors of the methods that were tried before
---@field file? string file of the recipe
---@field line? integer line of the recipe

--- One line for each stage of the sweep; it prints as these lines.
---@class lacuna.Report: string[]
---@field seconds table<string, number> by stage

--- A table of numbers in contiguous memory, row by row. #buffer is the number of rows.
---@class lacuna.Buffer
---@field rows integer
---@field columns integer
---@field type "float64"|"int32"
local Buffer = {}
--- One row.
---@param i integer
---@return number ...
function Buffer:row(i) end
--- Iterator over the rows: for i, x, y, z in buffer:each() do
---@return fun(): integer, ...
function Buffer:each() end
--- All values as bytes, in the machine's byte order.
---@return string
function Buffer:bytes() end

---@class lacuna.LeftOut
---@field region string
---@field code string code of the error
---@field message string

---@class lacuna.Mesh
---@field left_out lacuna.LeftOut[] empty
---@field fidelity lacuna.Fidelity
---@field nodes integer
---@field hexes integer
---@field wedges integer
---@field pyramids integer
---@field tets integer
---@field layers integer
---@field order 1|2
---@field regions string[] the name of the volume
---@field report lacuna.Report
local Mesh = {}
--- Scaled Jacobian, certificate, volume and other metrics of the cells.
---@return lacuna.Quality
function Mesh:quality() end
--- Groups of quads and cells, as they are written to files.
---@return { name: string, dim: integer, cells: integer }[]
function Mesh:groups() end
--- A translated, rotated or mirrored copy. In a mirrored copy the node order of each cell is reversed, so
--- that the cells stay positive.
---@param options lacuna.CopyOptions
---@return lacuna.Mesh
function Mesh:copy(options) end
--- The mesh and its copies, each moved relative to the one before, as one mesh.
---@param options lacuna.PatternOptions
---@return lacuna.AssemblyMesh
function Mesh:pattern(options) end
--- Coordinates of a node.
---@param i integer
---@return number x
---@return number y
---@return number z
function Mesh:node(i) end
--- Six node numbers, Gmsh order.
---@param i integer
---@return integer ... six numbers of nodes
function Mesh:wedge(i) end
--- Eight node numbers, Gmsh order.
---@param i integer
---@return integer ...
function Mesh:hex(i) end
--- Coordinates x, y, z of all nodes.
---@return lacuna.Buffer
function Mesh:coordinates() end
--- Node numbers of all cells of a kind, from 1; for order 2 including the mid-side nodes, in VTK's order.
---@param kind? "hex"|"wedge"|"pyramid"|"tet" default "hex"
---@return lacuna.Buffer
function Mesh:cells(kind) end
--- A metric of every cell of a kind, in the order of `cells(kind)`.
---@param metric? lacuna.MetricName default "scaled_jacobian"; for cells other than hexahedra "scaled_jacobian", "jacobian" or "volume"
---@param kind? "hex"|"wedge"|"pyramid"|"tet" default "hex"
---@return lacuna.Buffer
function Mesh:field(metric, kind) end
--- Write the mesh to a file. The extension sets the format.
---@param path string .msh, .vtu, .pvtu, .vtk, .inp, .bdf, .nas, .dat, .unv, .exo, .e, .k, .feb, .med, or a folder called polyMesh
---@param options? lacuna.WriteOptions
function Mesh:write(path, options) end
--- Write an HTML page with the mesh, to rotate, cut and colour it.
---@param path string .html
---@param options? lacuna.PageOptions
function Mesh:view(path, options) end
--- Write a picture. No display is needed.
---@param path string .png
---@param options? lacuna.PictureOptions
function Mesh:picture(path, options) end

--- Quads on faces, without layers.
---@class lacuna.QuadMesh
---@field nodes integer
---@field quads integer
---@field triangles integer triangles of the faces' given meshes
---@field hexes integer 0
---@field layers integer 0
---@field order 1|2
---@field regions string[] names of faces
---@field report lacuna.Report
local QuadMesh = {}
--- Scaled Jacobian at the corners, in the plane of each corner, and the areas of the quads and of the faces.
---@return { min_scaled_jacobian: number, mean_scaled_jacobian: number, area: number, face_area: number, quads: integer, triangles: integer }
function QuadMesh:quality() end
---@return { name: string, dim: integer, cells: integer }[]
function QuadMesh:groups() end
---@param i integer
---@return number x
---@return number y
---@return number z
function QuadMesh:node(i) end
---@param i integer
---@return integer ... four numbers of nodes
function QuadMesh:quad(i) end
--- A model whose faces have these quads as their mesh, to sweep it.
---@return lacuna.Model
function QuadMesh:model() end
--- Coordinates x, y, z of all nodes.
---@return lacuna.Buffer
function QuadMesh:coordinates() end
--- Node numbers of all cells of a kind, from 1.
---@param kind? "quad"|"triangle" default "quad"
---@return lacuna.Buffer
function QuadMesh:cells(kind) end
---@param path string .msh, .vtu, .vtk, .inp, .bdf, .nas, .dat, .unv, .exo or .e
---@param options? lacuna.QuadsWriteOptions
function QuadMesh:write(path, options) end
---@param path string .html
---@param options? lacuna.PageOptions
function QuadMesh:view(path, options) end
---@param path string .png
---@param options? lacuna.FacePictureOptions
function QuadMesh:picture(path, options) end

--- Options for all volumes, and for pairs of volumes.
---@class lacuna.AssemblySweepOptions: lacuna.SweepOptions
---@field contacts? lacuna.ContactRequest ties and contacts of faces without common nodes

--- Several volumes that are meshed together.
---@class lacuna.Assembly
local Assembly = {}
--- Volumes whose faces touch or face each other without common nodes.
---@param options? lacuna.ContactsOptions
---@return lacuna.Contact[]
function Assembly:contacts(options) end
--- Mesh the volumes. The options apply to all volumes; `[volume] = options` replaces them for one.
---@param options? lacuna.AssemblySweepOptions|table<lacuna.Volume, lacuna.SweepOptions>
---@return lacuna.AssemblyMesh
function Assembly:sweep(options) end
--- Sweep and write one layer at a time, as Volume:sweep_to does.
---@param path string
---@param options? lacuna.SweepToOptions|table<lacuna.Volume, lacuna.SweepOptions>
---@return table report
function Assembly:sweep_to(path, options) end

--- A place where two volumes share no nodes because they are slightly further apart than the tolerance.
---@class lacuna.NearMiss
---@field a string region
---@field b string region
---@field face_a integer tag
---@field face_b integer tag
---@field edge? integer tag
---@field edge_of? string region
---@field least number smallest distance [model length]
---@field width number largest distance [model length]
---@field area? number
---@field length? number
---@field tolerance number the smallest with which the volumes would be joined there
---@field reach_in boolean the volumes overlap, and the distances are depths
---@field message string

---@class lacuna.AssemblyReport: lacuna.Report
---@field near_misses lacuna.NearMiss[]

--- Fidelity of an assembly: its totals, and each volume's.
---@class lacuna.AssemblyFidelity
---@field volume number volume of the cells [model length³]
---@field sealed_volume number [model length³]
---@field max_distance number [model length]
---@field mean_distance number [model length]
---@field regions table<string, lacuna.Fidelity>

--- The mesh of an assembly, with one region for each volume.
---@class lacuna.AssemblyMesh
---@field contacts lacuna.Contact[] ties and contacts between volumes
---@field interface_cells integer number of cells with zero thickness, made by `lacuna.split_interface`
---@field left_out lacuna.LeftOut[] volumes and pieces that `fallback = "leave_out"` left out
---@field fidelity lacuna.AssemblyFidelity
---@field nodes integer
---@field hexes integer
---@field wedges integer
---@field pyramids integer
---@field tets integer
---@field order 1|2
---@field layers table<string, integer> by region
---@field regions string[]
---@field report lacuna.AssemblyReport
local AssemblyMesh = {}
--- Scaled Jacobian, certificate, volume and other metrics of all cells.
---@return lacuna.Quality
function AssemblyMesh:quality() end
--- Groups of quads and cells, as they are written to files. The cells of each volume are a group.
---@return { name: string, dim: integer, cells: integer }[]
function AssemblyMesh:groups() end
--- A translated, rotated or mirrored copy. In a mirrored copy the node order of each cell is reversed, so
--- that the cells stay positive.
---@param options lacuna.CopyOptions
---@return lacuna.AssemblyMesh
function AssemblyMesh:copy(options) end
--- The mesh and its copies, each moved relative to the one before, as one mesh.
---@param options lacuna.PatternOptions
---@return lacuna.AssemblyMesh
function AssemblyMesh:pattern(options) end
--- Coordinates of a node.
---@param i integer
---@return number x
---@return number y
---@return number z
function AssemblyMesh:node(i) end
--- Eight node numbers, Gmsh order.
---@param i integer
---@return integer ...
function AssemblyMesh:hex(i) end
--- Coordinates x, y, z of all nodes.
---@return lacuna.Buffer
function AssemblyMesh:coordinates() end
--- Node numbers of all cells of a kind, from 1; for order 2 including the mid-side nodes, in VTK's order.
---@param kind? "hex"|"wedge"|"pyramid"|"tet" default "hex"
---@return lacuna.Buffer
function AssemblyMesh:cells(kind) end
--- A metric of every cell of a kind, in the order of `cells(kind)`. Of cells of order 2 only the
--- corners are used.
---@param metric? lacuna.MetricName default "scaled_jacobian"; for cells other than hexahedra "scaled_jacobian", "jacobian" or "volume"
---@param kind? "hex"|"wedge"|"pyramid"|"tet" default "hex"
---@return lacuna.Buffer
function AssemblyMesh:field(metric, kind) end
--- Six node numbers, Gmsh order.
---@param i integer
---@return integer ... six numbers of nodes
function AssemblyMesh:wedge(i) end
--- Node numbers of the four base corners and of the apex.
---@param i integer
---@return integer n1, integer n2, integer n3, integer n4, integer apex
function AssemblyMesh:pyramid(i) end
--- Four node numbers, Gmsh order.
---@param i integer
---@return integer n1, integer n2, integer n3, integer n4
function AssemblyMesh:tet(i) end
--- Write the mesh to a file. The extension sets the format.
---@param path string
---@param options? lacuna.WriteOptions
function AssemblyMesh:write(path, options) end
--- Write an HTML page with the mesh, to rotate, cut and colour it, for example by region.
---@param path string .html
---@param options? lacuna.PageOptions
function AssemblyMesh:view(path, options) end
--- Write a picture. No display is needed.
---@param path string .png
---@param options? lacuna.PictureOptions
function AssemblyMesh:picture(path, options) end

---@class lacuna.Synthetic
local synthetic = {}

--- Names of faces to omit: "source", "target", "wall_1" and so on; "walls": all walls.
---@alias lacuna.Drop string|string[]

--- A prism over a regular polygon, with regularly arranged holes; it can be twisted, tapered and bent.
---@param options? { sides?: integer, radius?: number, height?: number, holes?: integer, hole_radius?: number, twist?: number, taper?: number, bend?: number, facets?: integer, drop?: lacuna.Drop }
---@return lacuna.Model
function synthetic.prism(options) end
--- A ring; wall_1 is the outer cylinder, wall_2 the inner one.
---@param options? { inner?: number, outer?: number, height?: number, facets?: integer, drop?: lacuna.Drop }
---@return lacuna.Model
function synthetic.annulus(options) end
--- A bent pipe. If `inner` is above 0, wall_2 is the bore.
---@param options? { radius?: number, inner?: number, bend_radius?: number, angle?: number, facets?: integer, drop?: lacuna.Drop }
---@return lacuna.Model
function synthetic.elbow(options) end
--- A cylinder whose radius grows to radius × (1 + bulge) at half its height.
---@param options? { radius?: number, height?: number, bulge?: number, facets?: integer, drop?: lacuna.Drop }
---@return lacuna.Model
function synthetic.barrel(options) end
--- A plate with rows of round holes. wall_1 to wall_4 are its sides.
---@param options? { length?: number, width?: number, height?: number, holes?: integer, hole_radius?: number, facets?: integer, drop?: lacuna.Drop }
---@return lacuna.Model
function synthetic.plate(options) end

---@class lacuna
---@field version string
---@field gmsh_version string
---@field synthetic lacuna.Synthetic
local lacuna = {}
--- Read the faces of a file, or of several files as one model: CAD (.step .stp .iges .igs .brep .geo), facets
--- (.stl .obj), meshes and decks (.msh .inp .bdf .nas .dat .unv .vtk .vtu .exo .e .mesh).
---@param path string|string[]
---@param options? lacuna.LoadOptions
---@return lacuna.Model
function lacuna.load(path, options) end
--- An empty model, to which faces can be added.
---@param options? lacuna.ModelOptions
---@return lacuna.Model
function lacuna.model(options) end
--- Set the values in the table from the key=value arguments of the command line, and return the table.
---@generic T: table
---@param defaults T
---@return T
function lacuna.params(defaults) end
--- Volumes that are meshed together, sharing nodes where they share faces. Meshes among them are kept.
---@param volumes (lacuna.Volume|lacuna.Mesh|lacuna.AssemblyMesh)[]
---@return lacuna.Assembly
function lacuna.assembly(volumes) end

---@class lacuna.InterfaceOptions
---@field faces string|integer|(string|integer|string[])[] "all", a group, or an array of groups and pairs of regions; in the mesh of one sweep also numbers of layers, each the number below a split
---@field element? string Abaqus element type of the cells of order 1: "COH3D8", "GK3D8", or a type that begins with one of these, or "none"; default "COH3D8"
---@field name? string region and group of the cells; default "interface"

--- Duplicate the nodes of faces between two regions or layers, and insert a cell of zero thickness at each.
---@param mesh lacuna.Mesh|lacuna.AssemblyMesh
---@param options lacuna.InterfaceOptions
---@return lacuna.AssemblyMesh
function lacuna.split_interface(mesh, options) end
--- Quality of the solid elements of a mesh or deck in any format that can be read. For a file without solid
--- elements it is the quality of its quads, as QuadMesh:quality().
---@param path string
---@return lacuna.Quality
function lacuna.check(path) end
--- Convert a mesh or deck to another format. The extension of `to` sets the format.
---@param from string
---@param to string .msh .vtu .vtk .inp .bdf .nas .dat .unv .exo .e .k .feb .med
---@param options? lacuna.ConvertOptions
---@return { nodes: integer, elements: integer }
function lacuna.convert(from, to, options) end
--- Write an HTML page of a file: the cells of a mesh or deck with solid elements, otherwise the faces.
---@param file string in any format that can be read
---@param path string .html
---@param options? lacuna.ViewOptions
---@return "cells"|"faces"
function lacuna.view(file, path, options) end
--- Draw a file: the cells of a mesh or deck with solid elements, otherwise the faces. No display is needed.
---@param file string in any format that can be read
---@param path string .png
---@param options? lacuna.FileOptions
---@return "cells"|"faces"
function lacuna.picture(file, path, options) end

return lacuna
