# A stranger's project: all it knows is the place of the installed tree.
set(folder ${BUILD}/consumer)
set(prefix ${folder}/prefix)
file(REMOVE_RECURSE ${folder})
file(MAKE_DIRECTORY ${folder})
# The sources go elsewhere first, so that no header of the repository can be found by accident.
file(COPY ${SOURCE}/examples/minimal ${SOURCE}/examples/own_loop DESTINATION ${folder})

separate_arguments(MPIEXEC)

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE code)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "exit code ${code}: ${ARGN}")
  endif()
endfunction()

function(expect file)
  if(NOT EXISTS ${file})
    message(FATAL_ERROR "${file} is not there")
  endif()
endfunction()

run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix})
# By CMake, in projects that know no language but C++.
function(build example where)
  file(STRINGS ${folder}/${example}/CMakeLists.txt project REGEX "^project")
  if(NOT project MATCHES "LANGUAGES CXX")
    message(FATAL_ERROR "the project is to know C++ alone: ${project}")
  endif()
  run(${CMAKE_COMMAND} -S ${folder}/${example} -B ${where} -G Ninja -DCMAKE_BUILD_TYPE=Release
      -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_PREFIX_PATH=${prefix})
  run(${CMAKE_COMMAND} --build ${where})
endfunction()
build(minimal ${folder}/build)
# The installed meshes.
run(gmsh -2 -setnumber n 32 ${prefix}/share/fsi/meshes/box.geo -setnumber lz 0 -o ${folder}/box.msh)
run(${folder}/build/taylor-green -mesh ${folder}/box.msh)
run(${MPIEXEC} 2 ${folder}/build/taylor-green -mesh ${folder}/box.msh)

# A loop of one's own gives the digits of Solver::step: it compares them and fails where they part.
build(own_loop ${folder}/build_loop)
run(gmsh -2 -setnumber n 32 ${prefix}/share/fsi/meshes/cavity.geo -o ${folder}/cavity.msh)
run(${folder}/build_loop/own-loop -mesh ${folder}/cavity.msh)
run(${MPIEXEC} 2 ${folder}/build_loop/own-loop -mesh ${folder}/cavity.msh)

# By pkg-config.
file(GLOB_RECURSE pc ${prefix}/*/fsi.pc)
get_filename_component(pc_folder "${pc}" DIRECTORY)
set(ENV{PKG_CONFIG_PATH} ${pc_folder})
execute_process(COMMAND pkg-config --cflags --libs fsi OUTPUT_VARIABLE flags RESULT_VARIABLE code
                OUTPUT_STRIP_TRAILING_WHITESPACE)
if(NOT code EQUAL 0)
  message(FATAL_ERROR "pkg-config does not find fsi in ${pc_folder}")
endif()
separate_arguments(flags)
run(${COMPILER} -std=c++20 -O1 ${folder}/minimal/taylor_green.cpp -o ${folder}/by-pkg-config ${flags})
run(${folder}/by-pkg-config -mesh ${folder}/box.msh)

# Programs, licence, and an example run and drawn from the installed tree alone.
file(GLOB drivers ${SOURCE}/drivers/*.cpp)
foreach(driver IN LISTS drivers)
  get_filename_component(name ${driver} NAME_WE)
  execute_process(COMMAND ${prefix}/bin/fsi-${name} -version OUTPUT_VARIABLE told RESULT_VARIABLE code)
  if(NOT code EQUAL 0 OR NOT told MATCHES "^fsi-${name} [0-9.]+, commit [^ ]+; PETSc")
    message(FATAL_ERROR "fsi-${name} -version: ${code} ${told}")
  endif()
endforeach()
expect(${prefix}/share/doc/fsi/LICENSE)
expect(${prefix}/share/fsi/examples/sweep/run)
set(ENV{RANKS} 1)
set(ENV{OMPI_ALLOW_RUN_AS_ROOT} 1)
set(ENV{OMPI_ALLOW_RUN_AS_ROOT_CONFIRM} 1)
file(MAKE_DIRECTORY ${folder}/work)
run(${CMAKE_COMMAND} -E chdir ${folder}/work ${prefix}/share/fsi/examples/run cavity -time_end 0.2
    -output_interval 0.1)
expect(${folder}/work/out/cavity/flow.png)
