# A stranger's project: all it knows is the place of the installed tree.
set(folder ${BUILD}/consumer)
set(prefix ${folder}/prefix)
file(REMOVE_RECURSE ${folder})
file(MAKE_DIRECTORY ${folder})
# The sources go elsewhere first, so that no header of the repository can be found by accident.
file(COPY ${SOURCE}/examples/minimal DESTINATION ${folder})

separate_arguments(MPIEXEC)

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE code)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "exit code ${code}: ${ARGN}")
  endif()
endfunction()

run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix})
run(${CMAKE_COMMAND} -S ${folder}/minimal -B ${folder}/build -G Ninja -DCMAKE_BUILD_TYPE=Release
    -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_PREFIX_PATH=${prefix})
run(${CMAKE_COMMAND} --build ${folder}/build)
run(gmsh -2 -setnumber n 32 ${SOURCE}/meshes/box.geo -setnumber lz 0 -o ${folder}/box.msh)
run(${folder}/build/taylor-green -mesh ${folder}/box.msh)
run(${MPIEXEC} 2 ${folder}/build/taylor-green -mesh ${folder}/box.msh)
