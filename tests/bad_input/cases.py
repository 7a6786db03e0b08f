"""The table of bad input: name, driver, arguments or damaged mesh, fragments of the sentence."""
import os

import faults as f
import vessel_cases

# Small meshes: geometry, dimension, parameters.
MESHES = {
    "cavity": ("cavity", 2, {"n": 6}),
    "box": ("box", 2, {"n": 6, "lz": 0}),
    "thin": ("box", 2, {"n": 6, "nx": 2, "lz": 0}),
    "one": ("cavity", 2, {"n": 1}),
    "shear": ("shear", 2, {"n": 4, "H": 8}),
    "pipe": ("pipe", 3, {"n": 4, "length": 1}),
}


class Case:
    """A run that must fail. `mesh` names a good mesh, `damage` what is done to it."""

    def __init__(self, name, driver, arguments, *fragments, mesh="cavity", damage=None, yaml=None,
                 size=None, files=None):
        self.name, self.driver, self.fragments = name, driver, fragments
        self.words, self.mesh, self.damage, self.yaml = arguments, mesh, damage, yaml
        self.files = files or {}  # beside the case: name, text
        self.size = size  # of the damaged file: it goes on with a hole up to there

    def arguments(self, made, folder):
        words = list(self.words)
        if self.mesh:
            path = made[self.mesh]
            if self.damage:
                with open(path, encoding="utf-8") as file:
                    text = self.damage(file.read())
                path = os.path.join(folder, self.name.replace(" ", "-") + ".msh")
                with open(path, "w", encoding="utf-8") as file:
                    file.write(text)
                if self.size:
                    os.truncate(path, self.size)
            words = ["-mesh", path] + words
        for name, text in self.files.items():
            with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                file.write(text)
        if self.yaml is not None:
            path = os.path.join(folder, self.name.replace(" ", "-") + ".yaml")
            with open(path, "w", encoding="utf-8") as file:
                file.write(self.yaml)
            words = [path] + words
        return words


def option(name, arguments, *fragments, driver="fsi-cavity", **more):
    return Case(name, driver, arguments.split(), *fragments, **more)


def mesh(name, damage, *fragments, driver="fsi-cavity", arguments="", of="cavity", size=None):
    return Case(name, driver, arguments.split(), *fragments, mesh=of, damage=damage, size=size)


OPTIONS = [
    option("misspelt option", "-fluid_viscosty 0.1", "-fluid_viscosty", "-fluid_viscosity"),
    option("a value for a block", "-fluid 3", "-fluid (a block of a case file", "fluid: {...}"),
    option("viscosity NaN", "-fluid_viscosity nan", "-fluid_viscosity", "nan", "value > 0"),
    option("viscosity infinite", "-fluid_viscosity inf", "-fluid_viscosity", "inf"),
    option("viscosity negative", "-fluid_viscosity -1", "-fluid_viscosity", "-1", "value > 0"),
    option("viscosity a word", "-fluid_viscosity thick", "-fluid_viscosity", "thick"),
    option("solid too viscous", "-solid_shape sphere -solid_viscosity 2.1", "-solid_viscosity",
           "200 times", "-solid_shear_modulus"),
    option("solid too heavy", "-solid_shape sphere -solid_density 21", "-solid_density",
           "0.1 to 20 times -fluid_density"),
    option("density zero", "-fluid_density 0", "-fluid_density", "value > 0"),
    option("a division anew of a run in one go", "-solid_shape sphere -solid_radius 0.15 -solid_center 0.5,0.5,0"
           " -restart_divide", "-restart_divide", "in one go", driver="fsi-advect"),
    option("steps of a motion that is given", "-solid_shape sphere -solid_radius 0.15 -solid_center 0.5,0.5,0"
           " -describe_step", "-describe_step", "computes no flow", driver="fsi-advect"),
    option("value missing", "-time_end", "-time_end"),
    option("end of time zero", "-time_end 0", "-time_end", "value > 0"),
    option("Courant number too large", "-time_courant 7", "-time_courant", "<= 1"),
    option("time step negative", "-time_step -0.1", "-time_step", ">= 0"),
    option("interval negative", "-sample_interval -1", "-sample_interval", ">= 0"),
    option("more files than anybody reads", "-output_interval 1e-9", "-output_interval", "files", "or more"),
    option("more rows than anybody reads", "-sample_interval 1e-12", "-sample_interval", "rows"),
    option("partitioner unknown", "-petscpartitioner_type scotsch", "-petscpartitioner_type",
           "scotsch", "metis, ptscotch, simple"),
    option("way of division without its partitioner",
           "-petscpartitioner_type simple -mesh_divide_along 1,0,0", "-mesh_divide_along"),
    option("option of another driver", "-inlet_pressure 5", "-inlet_pressure"),
    option("option twice", "-time_end 1 -time_end 2", "-time_end", "twice"),
    option("stray word", "0.5", "0.5"),
    option("list too short", "-solid_shape sphere -solid_center 1,2", "-solid_center"),
    option("list of words", "-solid_shape sphere -solid_center a,b,c", "-solid_center"),
    option("shape unknown", "-solid_shape torsu", "torsu", "torus"),
    option("kinematics unknown", "-solid_kinematics refmap", "refmap",
           "log_conformation, left_cauchy_green, reference_map"),
    option("law unknown", "-solid_law ogden", "-solid_law", "ogden", "neo_hookean, mooney_rivlin, gent"),
    option("law's share above one", "-solid_law mooney_rivlin -solid_law_c2_share 1.5",
           "-solid_law_c2_share", "1.5", "<= 1"),
    option("law's share negative", "-solid_law mooney_rivlin -solid_law_c2_share -0.1",
           "-solid_law_c2_share", "-0.1", "0 <= value"),
    option("law's limit zero", "-solid_law gent -solid_law_limit 0", "-solid_law_limit", "value > 0"),
    option("law's limit NaN", "-solid_law gent -solid_law_limit nan", "-solid_law_limit", "nan"),
    option("option of another law", "-solid_shape sphere -solid_center 0.5,0.5,0 -solid_law gent "
           "-solid_law_c2_share 0.3", "-solid_law_c2_share", "mooney_rivlin", "gent"),
    option("film of another kinematics", "-solid_shape sphere -solid_center 0.5,0.5,0 -solid_film_thickness 0.01 "
           "-solid_kinematics reference_map", "-solid_film_thickness", "log_conformation"),
    option("film thicker than the solid", "-solid_shape sphere -solid_center 0.5,0.5,0 -solid_film_thickness 2",
           "-solid_film_thickness", "2 is more than the solid's own thickness, 0.4", "the same unit"),
    option("one solid beside a list", "-solid_shape sphere -solids_a_shape sphere", "-solid_shape",
           "-solids_a_shape"),
    option("motion of three dimensions", "-solid_shape sphere -velocity deformation", "-velocity",
           "three dimensions", driver="fsi-advect"),
    option("axis and angle", "-solid_shape disk -solid_axis 1,0,0 -solid_angle 30", "-solid_axis",
           "-solid_angle"),
    option("tube wider than its ring", "-solid_shape torus -solid_major_radius 0.1",
           "-solid_minor_radius", "-solid_major_radius"),
    option("option of another shape", "-solid_shape sphere -solid_height 1", "-solid_height", "capsule",
           "sphere"),
    option("shear modulus NaN", "-solid_shear_modulus nan", "-solid_shear_modulus"),
    option("solid outside", "-solid_shape sphere -solid_center 3,3,0", "empty"),
    option("solid through the wall", "-solid_shape sphere -solid_center 0.1,0.5,0", "sticks out"),
    option("shear rate zero", "-shear_rate 0 -mesh_periodic left,right", "-shear_rate", "value > 0",
           driver="fsi-shear", mesh="shear"),
    option("shear rate NaN", "-shear_rate nan", "-shear_rate", "nan", driver="fsi-shear", mesh="shear"),
    option("shear between sides that are not joined", "", "left", driver="fsi-shear", mesh="shear"),
    option("solver unknown", "-p_ksp_type conjugat", "-p_ksp_type", "conjugat", "cg"),
    option("preconditioner unknown", "-p_pc_type hypr", "-p_pc_type", "hypr", "hypre"),
    option("preconditioner of assembled matrices", "-u_pc_type sor", "-u_pc_type", "sor", "jacobi"),
    option("solver without that norm", "-p_ksp_type minres", "minres", "norm"),
    option("solver's tolerance NaN", "-p_ksp_rtol nan", "-p_ksp_rtol", "nan", "0 < value < 1"),
    option("solver's tolerance no number", "-u_ksp_rtol abc", "-u_ksp_rtol", "abc", "0 < value < 1"),
    option("solver's tolerance zero", "-p_ksp_rtol 0", "-p_ksp_rtol", "\"0\"", "0 < value < 1"),
    option("solver's tolerance above one", "-u_ksp_rtol 2", "-u_ksp_rtol", "\"2\"", "0 < value < 1"),
    option("solver's iterations negative", "-p_ksp_max_it -5", "-p_ksp_max_it", "-5", "value >= 1"),
    option("solver's iterations no whole number", "-u_ksp_max_it 1.5", "-u_ksp_max_it", "1.5"),
    option("solver's absolute tolerance negative", "-p_ksp_atol -1", "-p_ksp_atol", "value >= 0"),
    option("step fixed and bounded", "-time_step 0.1 -time_step_max 0.01", "-time_step",
           "-time_step_max", "one of them"),
    option("nothing to restart from", "-restart -output_dir out/nothing", "no checkpoint",
           "out/nothing"),
    option("yaml key twice", "", "twice", yaml="time_end: 1\ntime_end: 2\n"),
    option("command unknown", "chek a.msh", "\"chek\"", "check in.msh", driver="fsi-mesh", mesh=None),
    option("command missing", "", "command is missing", "check in.msh", driver="fsi-mesh", mesh=None),
    option("command without its file", "check", "check in.msh", "0 words", driver="fsi-mesh", mesh=None),
    option("command's option misspelt", "check a.msh -wals wall", "-wals", "-walls", driver="fsi-mesh",
           mesh=None),
    option("command's file not there", "check nowhere.msh", "nowhere.msh", "cannot be opened",
           driver="fsi-mesh", mesh=None),
    option("file of worst cells of another kind", "check a.msh -worst_file a.vtu", "-worst_file", ".hdf",
           driver="fsi-mesh", mesh=None),
    option("no mesh", "", "-mesh", mesh=None),
    option("mesh not there", "-mesh nowhere.msh", "nowhere.msh", "cannot be opened", mesh=None),
    option("mesh a folder", "-mesh .", "\".\"", "is a folder", mesh=None),
    option("yaml block without keys", "", "not valid", "line 2: a block without keys", yaml="time_end: 1\nsolids: {}\n"),
    option("yaml list of blocks", "", "line 2: a list of blocks", "a name of its own", yaml="solids:\n  - {shape: torus}\n"),
    option("yaml not there", "nowhere.yaml", "nowhere.yaml", "cannot be opened", mesh=None),
    option("yaml broken", "", "not valid YAML of options: line 2", yaml="fluid: {density: [1, 2\n time: }"),
    option("yaml brace missing", "", "line 2: ", "begins in line 1", yaml="fluid: {density: 1\ntime: {end: 1}\n"),
    option("yaml indented wrongly", "", "line 3: ", yaml="fluid:\n  density: 1\n   viscosity: 1\n"),
    option("yaml with a tab", "", "line 2: ", "tab", yaml="fluid:\n\tdensity: 1\n"),
    option("all patches periodic", "-mesh_periodic left,right,bottom,top", "\"top\"",
           "all patches are periodic", mesh="box"),
    option("yaml unknown key", "", "-fluid_colour", yaml="fluid: {colour: 3}\n"),
    option("yaml value", "", "-fluid_density", "-3", yaml="fluid:\n  density: -3\n"),
]

MESH = [
    option("three periodic names", "-mesh_periodic left,right,top", "pairs", mesh="box"),
    option("periodic name unknown", "-mesh_periodic left,rigth", "rigth", "left", "right",
           mesh="box"),
    option("a geometry for a mesh", "-mesh vessel.geo", "vessel.geo", "is a geometry", "gmsh -3", mesh=None),
    mesh("empty file", f.empty, "empty"),
    mesh("garbage", f.garbage, "garbage.msh"),
    mesh("truncated", f.truncated, "truncated.msh"),
    mesh("format 1", f.oldest, "format 1", "2.2, 4.0 or 4.1"),
    mesh("version 1", f.version("1.0"), "2.2, 4.0 or 4.1"),
    mesh("version 3", f.version("3.0"), "2.2, 4.0 or 4.1"),
    mesh("version 5", f.version("5"), "2.2, 4.0 or 4.1"),
    mesh("node NaN", f.node(20, 0, "nan"), "node"),
    mesh("node far away", f.node(20, 0, "1e200"), "1e+200 wide", "unit of length"),
    mesh("node infinite", f.node(20, 0, "inf"), "node"),
    mesh("node a word", f.node(20, 0, "left"), "left"),
    mesh("unknown node", f.elements(f.unknown_node), "999999"),
    mesh("count beyond all files", f.announced("Nodes", "1000000000000000"), "1000000000000000 nodes announced"),
    mesh("file larger than memory", lambda text: text, "larger-than-memory.msh", "4.4 TB", "GB of memory", size=2**42),
    mesh("edge collapsed", f.collapsed, "collapsed edge", "nodes", "same place"),
    mesh("mesh folded", f.folded, "same side", "folded on itself"),
    mesh("one cell", None, "only one cell", of="one"),
    mesh("cell tangled", f.elements(f.tangled), "cell"),
    mesh("node repeated", f.elements(f.repeated_node), "node"),
    mesh("cell duplicate", f.elements(f.duplicate), "cell"),
    mesh("face of three cells", f.elements(f.non_manifold), "cells"),
    mesh("cell inverted", f.elements(f.inverted, dim=3), "turned inside out", of="pipe", driver="fsi-pipe",
         arguments="-mesh_periodic inlet,outlet"),
    mesh("no cells", f.elements(lambda chosen: [], dim=3), "holds no volume elements", "Physical Volume", of="pipe",
         driver="fsi-pipe", arguments="-mesh_periodic inlet,outlet"),
    mesh("pipe aslant", f.turned(30, 2), "the period of the mesh is along (0.866, 0.5, 0)", "parallel to x",
         "fsi-vessel", of="pipe", driver="fsi-pipe", arguments="-mesh_periodic inlet,outlet"),
    mesh("pipe upright", f.turned(90, 2), "the period of the mesh is along (0, 1, 0)", "parallel to x",
         "fsi-vessel", of="pipe", driver="fsi-pipe", arguments="-mesh_periodic inlet,outlet"),
    mesh("pipe without a period", None, "no period", "-mesh_periodic", of="pipe", driver="fsi-pipe"),
    mesh("boundary face without a name", f.elements(f.dropped, cells=False), "boundary face"),
    mesh("no names", f.without("PhysicalNames"), "name"),
    mesh("divided by gmsh", f.partitioned, "partitioned by gmsh", "without -part"),
    mesh("patch misspelt", f.renamed("top", "topp"), "topp", "top, wall"),
    mesh("patch missing", f.renamed("top", "wall"), "top"),
    mesh("two cells across a period", None, "fewer than 3 cells", of="thin",
         arguments="-mesh_periodic left,right"),
    mesh("pair that does not match", f.node(3, 1, "0.9"), "left", of="box",
         arguments="-mesh_periodic left,right"),
    mesh("pair at an angle", None, "left", of="box", arguments="-mesh_periodic left,top"),
    mesh("mesh of another case", None, "top", driver="fsi-stenosis"),
]

CASES = {"options": OPTIONS, "mesh": MESH, "vessel": vessel_cases.cases(Case)}
