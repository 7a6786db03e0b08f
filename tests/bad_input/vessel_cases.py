"""The table of bad input, continued: fsi-vessel, its patches, tables and solids."""
import faults as f

# Patches of the mesh "box": left, right, bottom, top.
GOOD = {"left": "{type: flow_rate, flow_rate: 1}", "right": "{type: pressure}", "bottom": "{type: wall}",
        "top": "{type: wall}"}


def yaml(more="", **patches):
    """A case file whose patches are the good ones, but for those given (None: left out)."""
    lines = [f"  {name}: {text}" for name, text in {**GOOD, **patches}.items() if text]
    return "\n".join(["patches:", *lines, more, ""])


def cases(Case):
    def case(name, text, *fragments, arguments="", **more):
        more.setdefault("mesh", "box")
        return Case(name, "fsi-vessel", arguments.split(), *fragments, yaml=text, **more)

    def table(name, file, *fragments, key="flow_rate", **more):
        patches = {"flow_rate": {"left": "{type: flow_rate, flow_rate: table.csv}"},
                   "pressure": {"right": "{type: pressure, pressure: table.csv}"},
                   "velocity_file": {"left": "{type: velocity, velocity_file: table.csv}"}}[key]
        return case(name, yaml(**patches), "table.csv", *fragments, files={"table.csv": file}, **more)

    return [
        case("patch misspelt", yaml(left=None, lfet="{type: flow_rate, flow_rate: 1}"), "-patches_lfet_type",
             "\"lfet\" is unknown", "left, right", "did you mean left?"),
        case("patch too many", yaml(middle="{type: wall}"), "-patches_middle_type", "\"middle\""),
        case("patch misspelt without its type", yaml(rigth="{pressure: 3}"), "-patches_rigth_pressure",
             "left, right"),
        case("gravity out of the plane", yaml("gravity: [0, 0, -10]"), "gravity has the component -10 along z"),
        case("force out of the plane", yaml(), "the body force has the component 1 along z",
             arguments="-flow_body_force 0,0,1"),
        case("acceleration out of the plane", yaml("solid: {shape: sphere, radius: 0.1, center: [0.5, 0.5, 0], "
             "acceleration: [0, 0, 1]}"), "the acceleration of a solid has the component 1 along z"),
        case("condition at a joined patch", yaml(), "-patches_bottom_type", "-mesh_periodic bottom,top joins",
             "takes no condition", arguments="-mesh_periodic bottom,top"),
        case("patch missing", yaml(top=None), "\"top\"", "-patches_top_type", "windkessel"),
        case("patch without a key", yaml(top="wall"), "-patches_top", "top: {type: ...}"),
        case("key of a patch misspelt", yaml(right="{type: pressure, presure: 3}"),
             "-patches_right_presure", "did you mean pressure?", "pressure, period"),
        case("key of another type", yaml(right="{type: pressure, capacitance: 3}"),
             "-patches_right_capacitance", "type pressure", "pressure, period"),
        case("type misspelt", yaml(right="{type: presure}"), "-patches_right_type", "presure", "pressure"),
        case("name of a patch with a blank", yaml(), "\"left side\"", "letters", mesh="box",
             damage=f.renamed("left", "left side")),
        case("patches that differ by capitals", yaml(), "\"left\" and \"Left\"", "capitals",
             damage=f.renamed("right", "Left")),
        case("option of two patches", yaml(right="{type: windkessel, distal_resistance: 10, capacitance: 0.1}",
             left=None, right_stored="{type: pressure, pressure: 3}"), "-patches_right_stored_pressure",
             "\"right\" and of patch \"right_stored\"", "rename", damage=f.renamed("left", "right_stored")),
        case("option of two patches on the command line", yaml(left=None, top_wall="{type: velocity}"),
             "-patches_top_wall_velocity", "\"top\" and of patch \"top_wall\"", "rename",
             arguments="-patches_top_wall_velocity 1,0,0", damage=f.renamed("left", "top_wall")),
        case("table of two patches", yaml(right="{type: windkessel, distal_resistance: 10, capacitance: 0.1}",
             left=None, right_stored="{type: pressure, pressure: table.csv}"), "-patches_right_stored_pressure",
             "rename", damage=f.renamed("left", "right_stored"), files={"table.csv": "t,p\n0,1\n1,2\n"}),
        case("patch of a number without a type", yaml(left="{type: wall}", right=None), "\"left_2\"",
             "-patches_left_2_type", damage=f.renamed("right", "left_2")),
        case("option of two solids", yaml("solids: {ring: {shape: torus, center: [0.5, 0.5, 0]}, ring_minor: "
             "{shape: sphere, radius: 0.2}}"), "-solids_ring_minor_radius",
             "\"ring\" and of solid \"ring_minor\"", "rename"),
        case("option of two solids on the command line", yaml(), "-solids_a_major_radius",
             "\"a\" and of solid \"a_major\"", "rename",
             arguments="-solids_a_shape torus -solids_a_major_shape disk -solids_a_major_radius 0.1"),
        case("both ends in one opening", yaml(left="{type: pressure}", right=None), "\"left\" face different ways",
             "a name of its own", damage=f.renamed("right", "left")),
        case("path from a patch to itself", yaml("solid: {shape: sphere, path: [left, left]}"), "-solid_path",
             "two different patches"),
        case("path to a wall", yaml("solid: {shape: sphere, path: [left, bottom]}"), "-solid_path",
             "\"bottom\" is a wall", "from one opening to another"),
        case("way along no path", yaml("solid: {shape: sphere, center: [0.5, 0.5, 0], arc_length: 1}"),
             "-solid_arc_length", "-solid_path"),
        case("solid longer than a period", yaml("solid: {shape: ellipsoid, center: [0.5, 0.5, 0], semi_axes: "
             "[0.7, 0.2, 0.2]}\nmesh_periodic: [left, right]", left=None, right=None), "overlaps its own image"),
        case("solid as long as a period", yaml("solid: {shape: cylinder, center: [0.5, 0.5, 0], axis: [1, 0, 0], "
             "radius: 0.2, height: 1}\nmesh_periodic: [left, right]", left=None, right=None),
             "touches its own image", "several periods"),
        case("path and centre", yaml("solid: {shape: sphere, path: [left, right], center: [0.5, 0.5, 0]}"),
             "-solid_path", "-solid_center", "exclude each other"),
        case("path and centre of one of several", yaml("solids: {one: {shape: sphere, path: [left, right], "
             "center: [0.5, 0.5, 0]}}"), "-solids_one_path", "-solids_one_center"),
        case("windkessel without its capacitance", yaml(right="{type: windkessel, distal_resistance: 3}"),
             "-patches_right_capacitance", "missing", "volume per pressure"),
        case("windkessel of no capacitance", yaml(right="{type: windkessel, capacitance: 0, "
             "distal_resistance: 3}"), "-patches_right_capacitance", "above 0", "type resistance"),
        case("windkessel without its resistance", yaml(right="{type: windkessel, capacitance: 3}"),
             "-patches_right_distal_resistance", "missing"),
        case("resistance without its own", yaml(right="{type: resistance}"), "-patches_right_resistance",
             "missing"),
        case("flow rate without its own", yaml(left="{type: flow_rate}"), "-patches_left_flow_rate",
             "missing"),
        case("velocity without its own", yaml(left="{type: velocity}"), "-patches_left_velocity",
             "-patches_left_velocity_file", "missing"),
        case("period of a number", yaml(left="{type: flow_rate, flow_rate: 0.5, period: 1}"),
             "-patches_left_period", "is a number", "csv"),
        case("table not there", yaml(left="{type: flow_rate, flow_rate: none.csv}"), "-patches_left_flow_rate",
             "none.csv"),
        case("folder for a table", yaml(left="{type: velocity, velocity_file: .}"), "cannot read the file"),
        table("columns of a table swapped", "flow_rate,time\n1,0\n2,1\n", "column 1", "\"flow_rate\"",
              "t or time"),
        table("table of something else", "time,pressure\n0,1\n1,2\n", "column 2", "\"pressure\"",
              "flow_rate or q or value"),
        table("table of a velocity, swapped", "t,value,x\n0,0,0\n", "names 3 columns", "x, y, z, ux, uy, uz",
              key="velocity_file"),
        table("table of a velocity in millimetres", "x,y,z,ux,uy,uz\n0,250,250,1,0,0\n0,750,750,1,0,0\n",
              "patch \"left\"", "the same units", key="velocity_file"),
        table("columns of a velocity, swapped", "ux,uy,uz,x,y,z\n0,0,0,1,0,0\n", "column 1", "\"ux\"",
              key="velocity_file"),
        table("table with a word in it", "t,p\n0,1\nnan,2\n", "\"nan,2\"", "2 numbers", key="pressure"),
        table("table with a second header", "pulse of today\nt,p\n0,1\n", "names 3 columns", "t or time",
              key="pressure"),
        table("decimal comma", "t;p\n0,5;1,5\n", "\"0,5;1,5\"", "2 numbers", key="pressure"),
        case("solid without a shape", yaml("solid: {radius: 0.1, path: [left, right]}"),
             "-solid_shape is missing", "-solid_path, -solid_radius", "sphere"),
        case("shape of one of several misspelt", yaml("solids: {one: {shpae: sphere}}"), "-solids_one_shpae",
             "-solids_NAME_shape"),
        case("key of one of several misspelt",
             yaml("solids: {one: {shape: sphere, radus: 0.1, center: [0.5, 0.5, 0]}}"),
             "-solids_one_radus", "-solids_one_radius"),
        case("path beside several solids",
             yaml("solids: {one: {shape: sphere, radius: 0.1, center: [0.5, 0.5, 0]}}"),
             "-solid_path", arguments="-solid_path left,right"),
    ]
