# What the checks of an installation share. They need SOURCE, this folder; SCAN, a scan; WORK, a scratch folder;
# GENERATOR and LAUNCHER, the build's generator and compiler launcher.

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}\nended with ${status}:\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

# Builds and runs the program of the folder `name` with what is installed under `prefix`.
function(check_consumer name prefix)
  set(build "${WORK}/${name}")
  run(${CMAKE_COMMAND} -S "${SOURCE}/${name}" -B "${build}" -G ${GENERATOR} "-DCMAKE_PREFIX_PATH=${prefix}"
      -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER} ${ARGN})
  run(${CMAKE_COMMAND} --build "${build}")
  file(MAKE_DIRECTORY "${build}/output")
  run("${build}/consumer" "${SCAN}" "${build}/output")
  message("${name}: ${output}")
endfunction()

# Looks for the files for clusters below `prefix`: the scripts must be programs.
function(check_cluster_files prefix)
  set(folder "${prefix}/share/rhombic/batch")
  foreach(file Snakefile slurm-7/config.yaml slurm-8/config.yaml job-array.sh shard-array.sh receive-study.sh)
    if(NOT EXISTS "${folder}/${file}")
      message(FATAL_ERROR "There is no ${folder}/${file}")
    endif()
  endforeach()
  foreach(script job-array receive-study)
    run(bash -c "test -x '${folder}/${script}.sh'")
  endforeach()
  file(WRITE "${WORK}/cluster/cases.tsv" "case\tscan\none\t${SCAN}\n")
  file(WRITE "${WORK}/cluster/mesh.yaml" "outputs: [{mesh: bone.stl, threshold: 375.5}]\n")
  run(env "PATH=${prefix}/bin:$ENV{PATH}" SLURM_ARRAY_TASK_ID=1 "${folder}/job-array.sh" "${WORK}/cluster/cases.tsv"
      "${WORK}/cluster/out" -q --pipeline "${WORK}/cluster/mesh.yaml")
  file(SIZE "${WORK}/cluster/out/one/bone.stl" size)
endfunction()
