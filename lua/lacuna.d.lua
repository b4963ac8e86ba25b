---@meta lacuna
-- SPDX-License-Identifier: MIT
-- The recipe language for the Lua language server: completion, hover and checking of recipes. Never run.
-- In .luarc.json: { "workspace.library": ["<where this file lies>"] }.

---@alias lacuna.Vector { [1]: number, [2]: number, [3]: number } x, y, z [model length]
---@alias lacuna.Thickness number|fun(x: number, y: number, z: number): number [model length]
---@alias lacuna.Class "I"|"II"|"III"|"IV"|"V"|"closed"|"0"

--- A face, its tag, its name, a selector, or an array of those.
---@alias lacuna.FaceRef lacuna.Face|integer|string|lacuna.Selector
---@alias lacuna.FaceRefs lacuna.FaceRef|lacuna.FaceRef[]

--- All that is set must hold.
---@class lacuna.Selector
---@field tags? integer|integer[]
---@field name? string a physical group, a part (`pid:7`), an element set
---@field kind? "plane"|"cylinder"|"cone"|"sphere"|"torus"|"bspline"|"surface"|"discrete"
---@field facing? lacuna.Vector the mean normal within 30 degrees of it
---@field normal_within? number instead of the 30 degrees of `facing`
---@field near? lacuna.Vector the one closest face
---@field within? number all faces that close to `near` instead [model length]
---@field box? { [1]: lacuna.Vector, [2]: lacuna.Vector } two corners of a box that all of the face lies in
---@field touching? lacuna.Face|integer|string a face it shares an edge with
---@field region? string the solid, part or set it bounds
---@field free? boolean whether it bounds one region alone
---@field radius? { [1]: number, [2]: number } smallest and largest, of parts of cylinders and spheres [model length]
---@field area? { [1]: number, [2]: number } smallest and largest [model length²]

---@class lacuna.LoadOptions
---@field tolerance? number gaps below it are sewn [model length]; default 1e-6 × the diagonal
---@field feature_angle? number where facets are cut into faces [degrees]; default 40
---@field keep_mesh? boolean given quads and nodes stay as they are; default true
---@field keep_noise? boolean points of noisy facets, as of a scan, stay where they are; default false: they are smoothed
---@field scale? number every coordinate times this; default 1
---@field unit? "um"|"mm"|"cm"|"m"|"in"|"ft" declared unit of the model's lengths; STEP and IGES are converted to it
---@field cad_seconds? number processor time the CAD process may take over it; in the sandbox it only lowers
---@field cad_megabytes? number address space the CAD process may take; in the sandbox it only lowers
---@field without? string|integer|(string|integer)[] regions, properties, sets or parts of meshes that are left out

---@class lacuna.ModelOptions
---@field tolerance? number points closer than this are one [model length]; default 1e-6 × the diagonal

---@class lacuna.FaceFromOptions
---@field near lacuna.Vector the facet closest to it is where the face begins [model length]
---@field angle? number the face goes on over sides that turn by no more [degrees]; default 20
---@field region? string only over faces that bound it
---@field free? boolean only over faces that bound one region alone, or two

---@class lacuna.NewFace
---@field name? string
---@field points lacuna.Vector[]
---@field cells integer[][] triangles and quads: numbers of points from 1
---@field keep_mesh? boolean quads are a mesh to be kept, not mere facets; default false

---@class lacuna.Roles
---@field source? lacuna.FaceRefs
---@field target? lacuna.FaceRefs
---@field walls? lacuna.FaceRefs|"auto" "auto": the source's cavity in a solid, else all that hangs on its rim
---@field faces? lacuna.FaceRefs instead of roles: these faces make the volume, and their roles are found
---@field reading? integer with roles to be found: which of the voids that were found, from 1
---@field full_turn? boolean the walls are a ring, swept round its whole turn; no ends; default false
---@field along? lacuna.Along with a source, and given walls if any: the path along which it is swept
---@field fill_to? { [1]: lacuna.Vector, [2]: lacuna.Vector } point and normal: only the part of the void behind this plane
---@field class? lacuna.Class override
---@field name? string what the cells are called: their group, set or property in files; default "volume"
---@field material? string|integer of the cells, in decks; default: as the elements beside them
---@field glued? boolean false: in an assembly it has nodes of its own, and ties to what it touches; default true

--- One of vector, axis, path, helix, normals and to.
---@class lacuna.Along
---@field vector? lacuna.Vector straight
---@field axis? { [1]: lacuna.Vector, [2]: lacuna.Vector } point and direction, turned round by `angle`
---@field angle? number of a turn round `axis`, up to 360 either way [degrees]
---@field path? lacuna.Vector[]|integer[]|fun(t: number): lacuna.Vector points with corners, tags of edges, or a smooth curve for t from 0 to 1
---@field frame? "minimal"|"fixed" with `path`: whether the source turns with it; default "minimal"
---@field helix? { [1]: lacuna.Vector, [2]: lacuna.Vector, [3]: number, [4]: number } point, direction, pitch and turns; negative turns: left-handed
---@field normals? lacuna.Thickness|{ [1]: lacuna.Thickness, [2]: lacuna.Thickness } thickness along the source's normals, or { inside, outside }
---@field to? lacuna.FaceRef along the source's mean normal onto this face
---@field twist? number|fun(height: number): number of the target, or at heights from 0 to 1 [degrees]
---@field scale? number|fun(height: number): number of the target, or at heights from 0 to 1

---@class lacuna.QuadsOptions
---@field faces? lacuna.FaceRefs default: all
---@field size? number|fun(x: number, y: number, z: number): number edge length; default: the rims' spacing
---@field curvature? integer sides for a full turn where the size is coarser; default 12; 0: the size alone
---@field gap? integer quads asked for across a narrow place; default: none, 3 where there is no size
---@field quads? "auto"|"paved"|"mapped"|"gmsh"|"keep" default "auto"; the report says which way each face was meshed
---@field order? 1|2 quads of 4, or of 9 nodes with middle nodes on curves and surfaces; default 1
---@field serendipity? boolean with order 2: quads of 8 nodes; default false
---@field threads? integer default: all cores

---@class lacuna.QuadsWriteOptions
---@field version? 4.1|2.2 of a .msh
---@field binary? boolean
---@field groups? "one"|"all" of a .msh: quads in one of their groups, or in all
---@field gmsh_options? boolean a file beside a .msh that says how Gmsh shows it

--- One of translate, rotate and mirror.
---@class lacuna.CopyOptions
---@field translate? lacuna.Vector
---@field rotate? { [1]: lacuna.Vector, [2]: lacuna.Vector, [3]: number } point, direction and angle [degrees]
---@field mirror? { [1]: lacuna.Vector, [2]: lacuna.Vector } point and normal of the plane
---@field name? string region of the copy; of several regions the start of their names; default: as the mesh

--- Translate or rotate, and count.
---@class lacuna.PatternOptions
---@field translate? lacuna.Vector from each copy to the next
---@field rotate? { [1]: lacuna.Vector, [2]: lacuna.Vector, [3]: number } point, direction and angle [degrees]
---@field count integer copies, the mesh itself included
---@field numbered? boolean regions are name_1, name_2 and so on; default false: copies are one region

---@class lacuna.MatchOptions
---@field vertices? { [1]: integer, [2]: integer }[] tags: source, target
---@field loops? { [1]: integer, [2]: integer }[] numbers: source, target
---@field flip? integer[] source loops whose direction on the target is turned round
---@field method? "aligned"|"nearest" default "aligned"

---@class lacuna.CloseOptions
---@field edge_shape? "auto"|"straight"|"follow"|"smooth" how a void edge runs; default "auto"
---@field void_edges? { [1]: integer, [2]: integer, [3]?: lacuna.Vector[] }[] given by hand: vertex tags from and to, points between
---@field cap? "auto"|"flat"|"parallel" shape of a missing end; default "auto"
---@field holes? "cover"|"through" holes of a given end that have no walls; without it an error where the other end is missing

---@class lacuna.Layers
---@field count integer
---@field bias? number last over first layer height (geometric), middle over end (bell), end over middle (both_ends)
---@field mode? "geometric"|"bell"|"both_ends" default "geometric"

---@class lacuna.BoundaryLayer
---@field walls lacuna.FaceRefs walls and ends; "walls": all walls, "void:<n>": a void face
---@field first number thickness of the cells at the face, square to it [model length]
---@field growth? number thickness of each row over the one before; default 1
---@field count? integer rows; default 1

--- What, how many sides, and the last length over the first (default 1). What: an edge's tag, the tags of
--- two vertices, a wall by Face, name or selector, or "sweep" for the layers.
---@class lacuna.Interval
---@field [1] integer|{ [1]: integer, [2]: integer }|lacuna.FaceRefs|"sweep"
---@field [2] integer
---@field [3]? number

--- Two faces, or groups of faces, that get the same mesh, and the motion from the first to the second;
--- default: a translation, or else the rotation by the smallest angle, that is found.
---@class lacuna.PeriodicPair
---@field [1] lacuna.FaceRefs
---@field [2] lacuna.FaceRefs
---@field translate? lacuna.Vector
---@field rotate? { [1]: lacuna.Vector, [2]: lacuna.Vector, [3]: number } point, direction, degrees

--- Two bodies whose faces touch or face each other.
---@class lacuna.Contact
---@field a string region
---@field b string region
---@field name? string of the pair; default: a_b
---@field type? "tie"|"contact" default "tie"
---@field gap? number within which the faces are looked for [model length]
---@field faces? { [1]: integer, [2]: integer }[] tags of the faces that come together
---@field least? number smallest distance within the gap [model length]
---@field width? number largest distance within the gap [model length]
---@field area? number of the faces of `a` within the gap [model length²]
---@field slave? string group of a mesh
---@field master? string group of a mesh

---@class lacuna.ContactsOptions
---@field gap? number largest distance of the faces; default 0: they touch [model length]

---@class lacuna.ContactRequest
---@field gap? number of pairs without an entry; default 0 [model length]
---@field type? "tie"|"contact" of pairs without an entry; default "tie"
---@field pairs? lacuna.Contact[] pairs with a gap, type or name of their own

---@class lacuna.SweepOptions
---@field layers? integer|number[]|lacuna.Layers a count, rising heights in (0, 1] or a spacing; default as the
---walls' own meshes have rows, else about as high as the quads are wide
---@field size? number|fun(x: number, y: number, z: number): number edge length on the source; default: the rim's spacing
---@field curvature? integer sides for a full turn where the size is coarser; default 12; 0: the size alone
---@field gap? integer quads asked for across a narrow place of the source; default: none, 3 where there is no size
---@field max_deviation? number how far the skin may be from the sealed skin [model length]; default: a quarter of a quad's side
---@field quads? "auto"|"paved"|"mapped"|"gmsh"|"keep" default "auto"; the report says which way each face was meshed
---@field fallback? "wedges"|"leave_out"|"mixed" what becomes of a volume that cannot be hexahedra alone; default: an error
---@field wedges? boolean triangles that an end came with stay, with wedges on them; default false: quads among triangles are an error
---@field rows? integer rows of quads from every loop of the source that stay as they are laid; default: what the paver finds good
---@field row_height? number|fun(x: number, y: number, z: number): number of those rows (one at least); default: the size
---@field boundary_layers? lacuna.BoundaryLayer|lacuna.BoundaryLayer[] thin rows of cells along walls and ends
---@field intervals? lacuna.Interval[] numbers of sides on edges, walls and along the sweep
---@field periodic? lacuna.PeriodicPair[] faces with the same mesh under a translation or rotation
---@field order? 1|2 of the cells: hex8, or hex27 with middle nodes on curves and surfaces; default 1
---@field serendipity? boolean with order 2: hex20 instead of hex27; default false
---@field min_scaled_jacobian? number below it the mesh is refused; default 0
---@field improve? boolean|{ iterations?: integer, seconds?: number } default true; iterations of each descent, 60
---@field interior? "auto"|"affine"|"residual"|"normals" how layers are placed; all but "auto" for comparison
---@field threads? integer default: all cores

---@class lacuna.SweepToOptions: lacuna.SweepOptions
---@field write? { version?: 4.1|2.2, binary?: boolean, quality?: boolean|lacuna.MetricName|lacuna.MetricName[], partitions?: integer|"processes", ghosts?: integer, interfaces?: boolean, groups?: "one"|"all", gmsh_options?: boolean } how the file is written; default as mesh:write

---@class lacuna.WriteOptions
---@field version? 4.1|2.2
---@field binary? boolean
---@field quality? boolean|lacuna.MetricName|lacuna.MetricName[] metrics that go along for every cell, as $ElementData or cell arrays; true: the scaled Jacobian; default true, but false for version 2.2
---@field with? lacuna.Model|lacuna.Model[] loaded from finite element meshes, that the mesh is joined to; the volume's first
---@field without? string|integer|(string|integer)[] regions, properties, sets or parts of these models that are left out
---@field renumber? boolean numbers and names that several decks have in common become others; default false
---@field first_node? integer of decks and with a model; default above all that are taken
---@field first_cell? integer likewise
---@field element? string Abaqus's word for the hexahedra of .inp; default "C3D8", of order 2 "C3D20"; thin layers: "COH3D8", "GK3D8", "SC8R", "CSS8"
---@field groups? "one"|"all" of .msh: whether cells are in one physical group or in all of theirs, which overlap; default "one"
---@field gmsh_options? boolean of .msh: a file beside it, .opt behind its name, with which Gmsh shows cells and groups; default false
---@field interfaces? boolean of an assembly: quads between its volumes are elements too; default false
---@field orientation? boolean directions of cells: fields in .vtu, .vtk and .exo, material axes in .inp and .bdf; default false
---@field partitions? integer|"processes" of .pvtu and .msh: parts; of .pvtu default as many as processes
---@field ghosts? integer rows of other parts' cells that are marked as each part's ghosts; default 0

---@class lacuna.ConvertOptions
---@field version? 4.1|2.2 of .msh; default 4.1
---@field binary? boolean of .msh and .vtk; default true
---@field groups? "one"|"all" of .msh; default "one"

---@class lacuna.PageOptions
---@field title? string default: what the input is called

---@class lacuna.ViewOptions: lacuna.PageOptions
---@field show? "auto"|"faces"|"cells" default "auto": cells of meshes that have solids, else faces

--- Of a model or volume.
---@class lacuna.FacePictureOptions
---@field width? integer default 1200 [pixels]
---@field height? integer default 900 [pixels]
---@field facets? boolean sides of the facets are drawn; default false
---@field legend? boolean a title, and what the colours mean; default true
---@field title? string default what is shown, counted
---@field view? "iso"|"front"|"back"|"left"|"right"|"top"|"bottom"|lacuna.Vector from what is seen to the eye; default "iso"

---@class lacuna.PictureOptions
---@field width? integer default 1200 [pixels]
---@field height? integer default 900 [pixels]
---@field view? "iso"|"front"|"back"|"left"|"right"|"top"|"bottom"|lacuna.Vector from what is seen to the eye; default "iso"
---@field colour? "quality"|"layer"|"groups"|"region"|"origin" default "quality"
---@field cut? { point: lacuna.Vector, normal: lacuna.Vector } cells whose centre lies behind the plane are shown whole
---@field layers? { [1]: integer, [2]: integer } first and last that is shown; default all
---@field edges? boolean sides of cells; default true
---@field legend? boolean a title, and what the colours mean; default true
---@field title? string default the name of the mesh and its counts

---@class lacuna.Classification
---@field class lacuna.Class
---@field free_loops integer
---@field wall_free_source integer[] tags of vertices on no wall
---@field wall_free_target integer[]
---@field reasons string[]

---@class lacuna.Match
---@field loops { source: integer, target: integer, flipped: boolean }[]
---@field vertices { [1]: integer, [2]: integer }[] tags: source, target
---@field method string
---@field confidence number 0 to 1
---@field notes string[]

---@class lacuna.Closure
---@field void_edges integer how many were made
---@field void_faces integer
---@field void_edge_tags integer[]
---@field void_face_tags integer[]
---@field watertight boolean
---@field algorithms string[] of the paper, in the order used

---@class lacuna.FreeEdge
---@field tag integer
---@field from integer tag of a vertex
---@field to integer
---@field length number [model length]

---@class lacuna.WorstCell
---@field cell integer
---@field layer? integer
---@field centre lacuna.Vector
---@field scaled_jacobian number

--- Verdict's metrics of hexahedra, as VTK computes them. `scaled_jacobian` is that of the corners alone,
--- Verdict's counts the centre too. `edge_ratio` is VTK's, which overlooks edges; `full_edge_ratio` compares
--- all twelve. `volume` is VTK's and Cubit's, from the centre alone; `Quality.volume` is exact.
---@alias lacuna.MetricName
---| "scaled_jacobian" | "scaled_jacobian_with_centre" | "jacobian" | "shape" | "shear" | "condition"
---| "max_aspect_frobenius" | "med_aspect_frobenius" | "oddy" | "skew" | "taper" | "max_edge_ratio" | "edge_ratio"
---| "full_edge_ratio" | "stretch" | "diagonal" | "dimension" | "volume" | "distortion" | "relative_size_squared"
---| "shape_and_size" | "shear_and_size"

---@class lacuna.MetricSummary
---@field name lacuna.MetricName
---@field cells integer cells for which it is defined
---@field min number
---@field mean number
---@field max number
---@field deviation number
---@field acceptable? { [1]: number, [2]: number } after Cubit; nil where it depends on the job
---@field outside integer cells outside the acceptable range
---@field outside_share number of all cells, 0 to 1
---@field worst { cell: integer, layer?: integer, centre: lacuna.Vector, value: number }

--- Prints as a table, with a histogram and a line a metric.
---@class lacuna.Quality
---@field hexes integer
---@field wedges integer
---@field pyramids integer
---@field tets integer
---@field least { hexes?: number, wedges?: number, pyramids?: number, tets?: number } smallest scaled Jacobian of each kind of cell that occurs
---@field min_scaled_jacobian number
---@field mean_scaled_jacobian number
---@field inverted integer cells with a corner that is not positive
---@field uncertified integer cells whose Jacobian was not shown positive everywhere
---@field certified boolean every cell is
---@field worst lacuna.WorstCell[] at most ten, worst first; of a swept mesh one of each column
---@field histogram integer[] of the scaled Jacobian, twenty bins over [-1, 1]
---@field metrics table<integer|lacuna.MetricName, lacuna.MetricSummary> in order and by name; measured when first asked for
---@field volume number [model length³]

---@class lacuna.Face
---@field tag integer the one Gmsh shows for the same file
---@field name string
---@field kind string
---@field area number [model length²]
---@field normal lacuna.Vector mean unit normal; zero all round a tube
---@field centroid lacuna.Vector
---@field loops integer
---@field edges integer
---@field has_mesh boolean
---@field radius? number of the cylinder or sphere that its facets lie on [model length]
---@field axis? lacuna.Vector of that cylinder
---@field box { [1]: lacuna.Vector, [2]: lacuna.Vector } its lowest and highest coordinates
---@field neighbours integer[] tags of faces that share an edge with it

---@class lacuna.Cavity
---@field kind "pocket"|"bore"|"slot"|"inner void"
---@field faces integer[] tags, for open_volume{ faces = … }
---@field class lacuna.Class
---@field volume number once it is sealed [model length³]

---@class lacuna.FaceInfo: lacuna.Face
---@field fits? "cylinder"|"sphere"|"cone" what its facets lie on
---@field centre? lacuna.Vector of that cylinder or sphere
---@field apex? lacuna.Vector tip of that cone, whose axis leads from it
---@field half_angle? number between axis and surface of that cone [degrees]
---@field least_radius? number of the face on that cone [model length]
---@field largest_radius? number of the face on that cone [model length]
---@field free_edges integer how many
---@field part integer of the sets of faces that hang together
---@field cavity? integer a number in `cavities`
---@field use string a kind of cavity, "outer skin" or "open shell"

---@class lacuna.ModelInfo
---@field source string
---@field diagonal number [model length]
---@field tolerance number [model length]
---@field parts integer sets of faces that hang together
---@field closed_parts integer those without free edges
---@field faces lacuna.FaceInfo[]
---@field free_edges { tag: integer, face: integer, from: integer, to: integer, length: number }[]
---@field gaps { edge: integer, other: integer, width: number, tolerance: number }[] with the tolerance that sews each
---@field cavities lacuna.Cavity[]

---@class lacuna.Model
---@field tolerance number [model length]
---@field diagonal number [model length]
local Model = {}
--- The faces that fit all that is named; without a selector all of them.
---@param selector? lacuna.Selector
---@return lacuna.Face[]
function Model:faces(selector) end
--- Exactly one; none or several is an error that lists the candidates.
---@param which lacuna.FaceRef
---@return lacuna.Face
function Model:face(which) end
--- A face grown from the facet closest to a place, taken out of the faces it goes over.
---@param options lacuna.FaceFromOptions
---@return lacuna.Face
function Model:face_from(options) end
--- Add a face of triangles and quads to the model. Points count from 1.
---@param face lacuna.NewFace
---@return lacuna.Face
function Model:add_face(face) end
--- The volume that faces bound, with the roles that are named. Without roles they are found, for `faces`
--- or all faces.
---@param roles? lacuna.Roles
---@return lacuna.Volume
function Model:open_volume(roles) end
--- Quads on faces, without layers.
---@param options? lacuna.QuadsOptions
---@return lacuna.QuadMesh
function Model:quads(options) end
--- Bodies whose faces touch or face each other.
---@param options? lacuna.ContactsOptions
---@return lacuna.Contact[]
function Model:contacts(options) end
--- Faces, free edges, gaps and cavities, in words.
---@return string
function Model:describe() end
--- The same as a table.
---@return lacuna.ModelInfo
function Model:info() end
--- Pockets, bores and inner voids of closed skins.
---@return lacuna.Cavity[]
function Model:cavities() end
--- A page for a browser: the faces, labelled, to be clicked for the roles of a recipe.
---@param path string .html
---@param options? lacuna.PageOptions
function Model:view(path, options) end
--- Drawn without a display: the faces, and their free edges.
---@param path string .png
---@param options? lacuna.FacePictureOptions
function Model:picture(path, options) end

---@class lacuna.CutOptions
---@field plane? { [1]: lacuna.Vector, [2]: lacuna.Vector } point and normal
---@field face? lacuna.FaceRef a Face of any model, or one of the volume's own
---@field auto? boolean where pieces result that can be swept: planes beside concave edges, or blocks at the vertices

---@class lacuna.Volume
---@field class lacuna.Class as the volume was given
local Volume = {}
--- Which faces are missing, and why the volume is of its class.
---@return lacuna.Classification
function Volume:classify() end
--- Take the volume as one of another class; what contradicts it is an error.
---@param class lacuna.Class
---@return lacuna.Volume self
function Volume:override_class(class) end
--- Pair the loops and vertices of source and target; `close` does it where this was not called.
---@param options? lacuna.MatchOptions
---@return lacuna.Match
function Volume:match(options) end
--- Make the edges and faces that are missing. The volume is sealed afterwards; `sweep` does it where this
--- was not called.
---@param options? lacuna.CloseOptions
---@return lacuna.Closure
function Volume:close(options) end
--- Whether nothing is missing.
---@return boolean
function Volume:is_watertight() end
--- Edges that have a missing face beside them.
---@return lacuna.FreeEdge[]
function Volume:free_edges() end
--- Volume, faces, edges and vertices as text, with the geometry of each; void ones are marked.
---@return string
function Volume:tree() end
--- Roles, class, what is missing and what was paired, as text.
---@return string
function Volume:describe() end
--- A page for a browser: roles, void faces, free edges and vertices on no wall.
---@param path string .html
---@param options? lacuna.PageOptions
function Volume:view(path, options) end
--- Drawn without a display: given faces, and those that were made.
---@param path string .png
---@param options? lacuna.FacePictureOptions
function Volume:picture(path, options) end
--- By a plane or a face: the pieces, which share what was cut. Without options: the pieces of a volume with
--- branches, or one of whose ends lies at several heights; itself where it has neither.
---@param options? lacuna.CutOptions
---@return lacuna.Volume[]
function Volume:cut(options) end
--- The volume's faces, void ones included.
---@return lacuna.Model
function Volume:model() end
--- Closes first where the recipe did not. A volume with steps is cut into pieces and meshed as an assembly.
---@param options lacuna.SweepOptions
---@return lacuna.Mesh|lacuna.AssemblyMesh
function Volume:sweep(options) end
--- Sweep and write a layer at a time, in memory that the number of layers hardly matters to: the bytes of
--- sweep(options):write(path). The report has nodes, hexes, wedges, layers, min_scaled_jacobian, streamed,
--- processes (with mpirun) and seconds by stage.
---@param path string .msh, .vtu, .pvtu, .vtk, .inp, .bdf, .nas, .dat, .unv, .exo, .e, .k or .feb
---@param options lacuna.SweepToOptions
---@return table report
function Volume:sweep_to(path, options) end
--- The facets of the sealed volume, watertight and outward.
---@param path string .stl, .msh or .obj
---@param options? { binary?: boolean, groups?: "one"|"all" } of .stl and .msh, default true; of .msh, default "one"
function Volume:write_facets(path, options) end
--- The sealed volume as one CAD solid: given CAD faces exact, void faces as planes or fitted surfaces.
---@param path string .step, .stp or .brep
---@param options? { tolerance?: number, deviation?: number, cad_seconds?: number, cad_megabytes?: number } gaps sewn up [model length]; how far the solid's volume may be from the facets' (default 0.05)
---@return { volume: number, faces: integer, planes: integer, fitted: integer, tolerance: number }
function Volume:write_cad(path, options) end

---@class lacuna.FaceFidelity
---@field quads integer of the skin that lie on it
---@field max_distance number [model length]; of a face without quads its width
---@field mean_distance number [model length]
---@field place lacuna.Vector where skin and face are furthest apart

--- The mesh's skin against the sealed skin.
---@class lacuna.Fidelity
---@field volume number of the cells [model length³]
---@field sealed_volume number [model length³]
---@field max_distance number [model length]
---@field mean_distance number [model length]
---@field faces table<integer|string, lacuna.FaceFidelity> by tag, void faces by "void:<n>"

--- What pcall gets when a call fails. It prints as one sentence, and has the methods of strings.
---@class lacuna.Error
---@field message string what was expected, what was found, what to try
---@field code string "folder.what_went_wrong": stable, for programs
---@field entities { kind: string, tag: integer }[] faces, edges, nodes… that the message names
---@field found (number|string)[] what the input has
---@field needed (number|string)[] what it would need instead
---@field remedy? string the part of the message that says what to try
---@field attempts { message: string, code: string, entities: { kind: string, tag: integer }[] }[] why what was tried failed too
---@field file? string of the recipe
---@field line? integer

--- A line a stage of the sweep; prints as lines.
---@class lacuna.Report: string[]
---@field seconds table<string, number> by stage

--- Numbers in rows, as they lie in memory. #buffer is the number of rows.
---@class lacuna.Buffer
---@field rows integer
---@field columns integer
---@field type "float64"|"int32"
local Buffer = {}
--- One row.
---@param i integer
---@return number ...
function Buffer:row(i) end
--- for i, x, y, z in buffer:each() do
---@return fun(): integer, ...
function Buffer:each() end
--- All of it, in the machine's order of bytes.
---@return string
function Buffer:bytes() end

---@class lacuna.LeftOut
---@field region string
---@field code string the error's
---@field message string

---@class lacuna.Mesh
---@field left_out lacuna.LeftOut[] none
---@field fidelity lacuna.Fidelity
---@field nodes integer
---@field hexes integer
---@field wedges integer
---@field pyramids integer
---@field tets integer
---@field layers integer
---@field order 1|2
---@field regions string[] the one volume's name
---@field report lacuna.Report
local Mesh = {}
--- Scaled Jacobian, certificate, volume and other metrics of the cells.
---@return lacuna.Quality
function Mesh:quality() end
--- Groups of quads and cells, as files have them.
---@return { name: string, dim: integer, cells: integer }[]
function Mesh:groups() end
--- A copy, moved as a whole; a mirrored one is turned over, so that its cells stay positive.
---@param options lacuna.CopyOptions
---@return lacuna.Mesh
function Mesh:copy(options) end
--- The mesh and copies of it, each moved against the one before, as one mesh.
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
--- Of every node x, y, z, as they lie in memory.
---@return lacuna.Buffer
function Mesh:coordinates() end
--- Of every cell the numbers of its nodes, from 1; of order 2 the middle nodes too, in VTK's order.
---@param kind? "hex"|"wedge"|"pyramid"|"tet" default "hex"
---@return lacuna.Buffer
function Mesh:cells(kind) end
--- A metric of every cell of a kind, in the order of `cells(kind)`.
---@param metric? lacuna.MetricName default "scaled_jacobian"; of cells that are no hexahedra also "jacobian" and "volume"
---@param kind? "hex"|"wedge"|"pyramid"|"tet" default "hex"
---@return lacuna.Buffer
function Mesh:field(metric, kind) end
--- A file in the format of its ending.
---@param path string .msh, .vtu, .pvtu, .vtk, .inp, .bdf, .nas, .dat, .unv, .exo, .e, .k, .feb, .med, or a folder called polyMesh
---@param options? lacuna.WriteOptions
function Mesh:write(path, options) end
--- A page for a browser: the mesh, to be turned, cut and coloured.
---@param path string .html
---@param options? lacuna.PageOptions
function Mesh:view(path, options) end
--- Drawn without a display.
---@param path string .png
---@param options? lacuna.PictureOptions
function Mesh:picture(path, options) end

--- Quads on faces, without layers.
---@class lacuna.QuadMesh
---@field nodes integer
---@field quads integer
---@field triangles integer that faces came with
---@field hexes integer 0
---@field layers integer 0
---@field order 1|2
---@field regions string[] names of faces
---@field report lacuna.Report
local QuadMesh = {}
--- Of the corners, in their planes; areas of the quads and of the faces.
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
--- The quads as faces that keep them, to be swept.
---@return lacuna.Model
function QuadMesh:model() end
--- Of every node x, y, z.
---@return lacuna.Buffer
function QuadMesh:coordinates() end
--- Of every cell the numbers of its nodes, from 1.
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

--- Of all volumes, and of pairs of them.
---@class lacuna.AssemblySweepOptions: lacuna.SweepOptions
---@field contacts? lacuna.ContactRequest ties and contacts of faces without common nodes

--- Several volumes to be meshed as one.
---@class lacuna.Assembly
local Assembly = {}
--- Volumes whose faces touch or face each other without common nodes.
---@param options? lacuna.ContactsOptions
---@return lacuna.Contact[]
function Assembly:contacts(options) end
--- Options for all volumes; `[volume] = options` lays those of one over them.
---@param options? lacuna.AssemblySweepOptions|table<lacuna.Volume, lacuna.SweepOptions>
---@return lacuna.AssemblyMesh
function Assembly:sweep(options) end
--- Sweep and write a layer at a time, as Volume:sweep_to: the bytes of sweep(options):write(path).
---@param path string
---@param options? lacuna.SweepToOptions|table<lacuna.Volume, lacuna.SweepOptions>
---@return table report
function Assembly:sweep_to(path, options) end

--- Where two volumes are a little further apart than the tolerance and share no nodes.
---@class lacuna.NearMiss
---@field a string region
---@field b string region
---@field face_a integer tag
---@field face_b integer tag
---@field edge? integer tag
---@field edge_of? string region
---@field least number length
---@field width number length
---@field area? number
---@field length? number
---@field tolerance number with which both models are one there
---@field reach_in boolean
---@field message string

---@class lacuna.AssemblyReport: lacuna.Report
---@field near_misses lacuna.NearMiss[]

--- Sums over the volumes of an assembly, and each volume's.
---@class lacuna.AssemblyFidelity
---@field volume number of the cells [model length³]
---@field sealed_volume number [model length³]
---@field max_distance number [model length]
---@field mean_distance number [model length]
---@field regions table<string, lacuna.Fidelity>

--- The mesh of an assembly, a region each.
---@class lacuna.AssemblyMesh
---@field contacts lacuna.Contact[] ties and contacts
---@field interface_cells integer cells of no thickness, from `lacuna.split_interface`
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
--- Groups of quads and cells, as files have them; each volume's cells are one.
---@return { name: string, dim: integer, cells: integer }[]
function AssemblyMesh:groups() end
--- A copy, moved as a whole; a mirrored one is turned over, so that its cells stay positive.
---@param options lacuna.CopyOptions
---@return lacuna.AssemblyMesh
function AssemblyMesh:copy(options) end
--- The mesh and copies of it, each moved against the one before, as one mesh.
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
--- Of every node x, y, z.
---@return lacuna.Buffer
function AssemblyMesh:coordinates() end
--- Of every cell of a kind the numbers of its nodes, from 1; of order 2 the middle nodes too, in VTK's order.
---@param kind? "hex"|"wedge"|"pyramid"|"tet" default "hex"
---@return lacuna.Buffer
function AssemblyMesh:cells(kind) end
--- A metric of every cell of a kind, in the order of `cells(kind)`. Of order 2 by the corners.
---@param metric? lacuna.MetricName default "scaled_jacobian"; of cells that are no hexahedra also "jacobian" and "volume"
---@param kind? "hex"|"wedge"|"pyramid"|"tet" default "hex"
---@return lacuna.Buffer
function AssemblyMesh:field(metric, kind) end
--- Six node numbers, Gmsh order.
---@param i integer
---@return integer ... six numbers of nodes
function AssemblyMesh:wedge(i) end
--- Four node numbers of the base, and the apex.
---@param i integer
---@return integer n1, integer n2, integer n3, integer n4, integer apex
function AssemblyMesh:pyramid(i) end
--- Four node numbers, Gmsh order.
---@param i integer
---@return integer n1, integer n2, integer n3, integer n4
function AssemblyMesh:tet(i) end
--- A file in the format of its ending.
---@param path string
---@param options? lacuna.WriteOptions
function AssemblyMesh:write(path, options) end
--- A page for a browser, regions told apart.
---@param path string .html
---@param options? lacuna.PageOptions
function AssemblyMesh:view(path, options) end
--- Drawn without a display.
---@param path string .png
---@param options? lacuna.PictureOptions
function AssemblyMesh:picture(path, options) end

---@class lacuna.Synthetic
local synthetic = {}

--- Names of faces to leave out: "source", "target", "wall_1"…; "walls" is all walls.
---@alias lacuna.Drop string|string[]

--- A regular prism with regular holes, twisted, tapered, bent.
---@param options? { sides?: integer, radius?: number, height?: number, holes?: integer, hole_radius?: number, twist?: number, taper?: number, bend?: number, facets?: integer, drop?: lacuna.Drop }
---@return lacuna.Model
function synthetic.prism(options) end
--- A ring; wall_1 is the outer cylinder, wall_2 the inner one.
---@param options? { inner?: number, outer?: number, height?: number, facets?: integer, drop?: lacuna.Drop }
---@return lacuna.Model
function synthetic.annulus(options) end
--- A bent pipe; wall_2 is the bore, where `inner` is above 0.
---@param options? { radius?: number, inner?: number, bend_radius?: number, angle?: number, facets?: integer, drop?: lacuna.Drop }
---@return lacuna.Model
function synthetic.elbow(options) end
--- A cylinder that bulges to radius (1 + bulge) half way up.
---@param options? { radius?: number, height?: number, bulge?: number, facets?: integer, drop?: lacuna.Drop }
---@return lacuna.Model
function synthetic.barrel(options) end
--- A plate with round holes in rows; walls 1 to 4 are its sides.
---@param options? { length?: number, width?: number, height?: number, holes?: integer, hole_radius?: number, facets?: integer, drop?: lacuna.Drop }
---@return lacuna.Model
function synthetic.plate(options) end

---@class lacuna
---@field version string
---@field gmsh_version string
---@field synthetic lacuna.Synthetic
local lacuna = {}
--- The faces of a file, or of several as one model: CAD (.step .stp .iges .igs .brep .geo), facets (.stl
--- .obj), meshes and decks (.msh .inp .bdf .nas .dat .unv .vtk .vtu .exo .e .mesh).
---@param path string|string[]
---@param options? lacuna.LoadOptions
---@return lacuna.Model
function lacuna.load(path, options) end
--- An empty model, to add faces to.
---@param options? lacuna.ModelOptions
---@return lacuna.Model
function lacuna.model(options) end
--- The table, with the key=value words of the command line laid over it.
---@generic T: table
---@param defaults T
---@return T
function lacuna.params(defaults) end
--- Volumes that share faces, to be meshed as one. Meshes among them stay as they are.
---@param volumes (lacuna.Volume|lacuna.Mesh|lacuna.AssemblyMesh)[]
---@return lacuna.Assembly
function lacuna.assembly(volumes) end

---@class lacuna.InterfaceOptions
---@field faces string|integer|(string|integer|string[])[] "all", a group, or an array of groups and pairs of regions; in the mesh of one sweep also numbers of layers, each the number below a split
---@field element? string Abaqus's word for the cells: "COH3D8", "GK3D8" or one that begins so, or "none"; default "COH3D8"
---@field name? string region and group of the cells; default "interface"

--- Double the nodes of faces between two regions or layers, and put a cell of no thickness on each.
---@param mesh lacuna.Mesh|lacuna.AssemblyMesh
---@param options lacuna.InterfaceOptions
---@return lacuna.AssemblyMesh
function lacuna.split_interface(mesh, options) end
--- Quality of the solids of a mesh or deck in any format that is read; of a file without solids that of its
--- quads, as QuadMesh:quality().
---@param path string
---@return lacuna.Quality
function lacuna.check(path) end
--- A mesh or deck in any format that is read, in the format of the other's ending.
---@param from string
---@param to string .msh .vtu .vtk .inp .bdf .nas .dat .unv .exo .e .k .feb .med
---@param options? lacuna.ConvertOptions
---@return { nodes: integer, elements: integer }
function lacuna.convert(from, to, options) end
--- A page of a file for a browser: the cells of a mesh or deck that has solids, else faces.
---@param file string in any format that is read
---@param path string .html
---@param options? lacuna.ViewOptions
---@return "cells"|"faces"
function lacuna.view(file, path, options) end

return lacuna
