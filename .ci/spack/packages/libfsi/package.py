# A recipe for Spack. In the folder of the sources:
#   spack repo add .ci/spack
#   spack dev-build libfsi@0.1.0
from spack.package import *


class Libfsi(CMakePackage):
    """Soft solids in viscous flow on unstructured meshes: a C++20 library and its programs."""

    license("BSD-3-Clause")

    version("0.1.0")

    variant("tests", default=False, description="build the test suite")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("ninja", type="build")
    depends_on("pkgconfig", type="build")
    depends_on("python@3.9:", type="build")
    depends_on("mpi")
    depends_on("petsc@3.18: ~complex +double ~int64 +mpi +hypre +metis +hdf5")
    depends_on("hdf5@1.10: +mpi")
    depends_on("libyaml")
    depends_on("metis@5.1: ~int64 ~real64")
    depends_on("gmsh@4.8:", type="run")
    depends_on("py-numpy", type="run")
    depends_on("py-h5py", type="run")
    depends_on("py-matplotlib", type="run")
    depends_on("googletest", type="build", when="+tests")

    generator("ninja")
    conflicts("%gcc@:11", msg="C++20 as gcc 12 has it is needed")

    def cmake_args(self):
        return [self.define_from_variant("FSI_BUILD_TESTS", "tests")]
