from spack.package import depends_on, license, variant, version
from spack_repo.builtin.build_systems.cmake import CMakePackage


class Reedvalve(CMakePackage):
    """How a cantilever reed valve opens and closes in oil: a program and a library."""

    license("MIT")

    # There is no archive to fetch; `spack dev-build` takes the sources at hand.
    version("0.1.0")

    variant("mpi", default=False, description="Build reedvalve_mpi, the program for MPI ranks")

    depends_on("c", type="build")
    depends_on("fortran", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("pkgconfig", type="build")
    # the serial vectors of ARKODE; with MPI, version 7 would want MPI's headers everywhere
    depends_on("sundials@6.4:7 +ARKODE ~mpi")
    depends_on("lapack")
    depends_on("netcdf-fortran")
    depends_on("mpi", when="+mpi")

    def cmake_args(self):
        return [
            self.define_from_variant("RV_WITH_MPI", "mpi"),
            self.define("RV_WITH_TESTS", self.run_tests),
        ]
