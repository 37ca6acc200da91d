# A small run of both programs: -DBIN=<folder of the programs> -DWORK=<folder to write to>
# -DEMBREE=<whether there is Embree>. Everything must be there and make sense; times are not judged.
cmake_minimum_required(VERSION 3.21)
file(REMOVE_RECURSE "${WORK}")
file(MAKE_DIRECTORY "${WORK}")
set(suffix "${CMAKE_EXECUTABLE_SUFFIX}")

# Runs a program in WORK. It must fail if EXPECTED is a message, and say so.
function (run program expected)
  execute_process(COMMAND "${BIN}/${program}" ${ARGN}
    WORKING_DIRECTORY "${WORK}" RESULT_VARIABLE result OUTPUT_VARIABLE out ERROR_VARIABLE err)
  if (expected STREQUAL "" AND NOT result EQUAL 0)
    message(FATAL_ERROR "${program} ${ARGN} failed: ${err}")
  elseif (NOT expected STREQUAL "" AND (result EQUAL 0 OR NOT err MATCHES "${expected}"))
    message(FATAL_ERROR "${program} ${ARGN} should have said \"${expected}\": ${err}")
  endif ()
  set(output "${out}" PARENT_SCOPE)
endfunction ()

# The volumes
foreach (field IN ITEMS gyroid marschner-lobb sphere)
  run(vtkIsosurfaceBenchmarkVolume "" --field ${field} --dimensions 32 --output ${field}.mhd)
endforeach ()
run(vtkIsosurfaceBenchmarkVolume "" --input sphere.mhd --dimensions 40,50,600 --output large.mhd)
file(SIZE "${WORK}/large.raw" size)
if (NOT size EQUAL 2400000 OR NOT output MATCHES "large.mhd: 40 x 50 x 600 samples from -29[0-9]* to 2")
  message(FATAL_ERROR "large.raw has ${size} bytes: ${output}")
endif ()
run(vtkIsosurfaceBenchmarkVolume "no field cube; there are: gyroid marschner-lobb sphere"
  --field cube --dimensions 32 --output cube.mhd)
run(vtkIsosurfaceBenchmarkVolume "from 2 to 16384 samples"
  --field sphere --dimensions 32,1,32 --output flat.mhd)
run(vtkIsosurfaceBenchmarkVolume "no file or folder none.mhd"
  --input none.mhd --dimensions 32 --output cube.mhd)
run(vtkIsosurfaceBenchmarkVolume "does its folder exist"
  --field sphere --dimensions 32 --output none/sphere.mhd)
run(vtkIsosurfaceBenchmarkVolume "is the input" --input sphere.mhd --dimensions 9 --output sphere.mhd)
run(vtkIsosurfaceBenchmarkVolume "Usage" --field sphere)
if (EXISTS /dev/full)
  file(CREATE_LINK /dev/full "${WORK}/full.raw" SYMBOLIC)
  run(vtkIsosurfaceBenchmarkVolume "is the disk full" --field sphere --dimensions 32 --output full.mhd)
  if (EXISTS "${WORK}/full.mhd")
    message(FATAL_ERROR "There is a header of a volume that is not complete.")
  endif ()
endif ()

# The benchmark: what it refuses
run(vtkIsosurfaceBenchmark "has values from .* so there is no surface"
  --input sphere.mhd --isovalue 40000)
run(vtkIsosurfaceBenchmark "there is no rival \"x\"" --input sphere.mhd --isovalue 0 --rivals x)
run(vtkIsosurfaceBenchmark "give numbers from 1 to 1024"
  --input sphere.mhd --isovalue 0 --threads 1,two)
run(vtkIsosurfaceBenchmark "cannot be written" --input sphere.mhd --isovalue 0 --json none/x.json)
run(vtkIsosurfaceBenchmark "Usage" --input sphere.mhd)

# ... and what it measures
run(vtkIsosurfaceBenchmark "" --input large.mhd --isovalue 0 --isovalue 2000 --size 64 --views 2
  --repeats 1 --threads 1,2 --goals --papers --growth 128 --json small.json --markdown small.md)
file(READ "${WORK}/small.json" json)
file(READ "${WORK}/small.md" markdown)

# The member VALUE of ROW of a table, as a number or as the median of several; empty for nothing.
function (get_number result row column)
  string(JSON value ERROR_VARIABLE error GET "${row}" "${column}")
  string(JSON median ERROR_VARIABLE error GET "${row}" "${column}" median)
  if (NOT error)
    set(value "${median}")
  endif ()
  set(${result} "${value}" PARENT_SCOPE)
endfunction ()

# The rows of the table must be so many; the columns named must be positive numbers in each.
function (check_table name count)
  string(JSON tables LENGTH "${json}" tables)
  math(EXPR last "${tables} - 1")
  foreach (i RANGE ${last})
    string(JSON found GET "${json}" tables ${i} name)
    if (NOT found STREQUAL name)
      continue ()
    endif ()
    string(JSON title GET "${json}" tables ${i} title)
    string(FIND "${markdown}" "### ${title}\n" place)
    if (place EQUAL -1)
      message(FATAL_ERROR "The Markdown has no table \"${title}\".")
    endif ()
    string(JSON rows LENGTH "${json}" tables ${i} rows)
    if (NOT rows EQUAL count)
      message(FATAL_ERROR "The table \"${name}\" has ${rows} rows, not ${count}.")
    endif ()
    math(EXPR lastRow "${rows} - 1")
    foreach (j RANGE ${lastRow})
      string(JSON row GET "${json}" tables ${i} rows ${j})
      foreach (column IN LISTS ARGN)
        get_number(value "${row}" "${column}")
        if (NOT value GREATER 0)
          message(FATAL_ERROR "The table \"${name}\" has \"${value}\" as \"${column}\": ${row}")
        endif ()
      endforeach ()
    endforeach ()
    string(JSON rows GET "${json}" tables ${i} rows)
    set(rows "${rows}" PARENT_SCOPE)
    return ()
  endforeach ()
  message(FATAL_ERROR "There is no table \"${name}\".")
endfunction ()

set(newIsovalueRows 6)
set(pictureRows 5)
set(goals 13)
if (EMBREE)
  set(newIsovalueRows 7)
  set(pictureRows 7)
  set(goals 17)
endif ()
foreach (isovalue IN ITEMS 0 2000)
  check_table("memory ${isovalue}" 5 MiB)
  check_table("new isovalue ${isovalue}" ${newIsovalueRows} "s" "times this mapper's")
  check_table("pictures ${isovalue}" ${pictureRows} "threads" "times this mapper's")
  # All see the same surface in the same view; fixed-point blends its border into the background.
  string(JSON ours GET "${rows}" 0 "pixels hit, %")
  math(EXPR last "${pictureRows} - 1")
  foreach (i RANGE ${last})
    string(JSON who GET "${rows}" ${i} "who")
    string(JSON theirs GET "${rows}" ${i} "pixels hit, %")
    string(REGEX REPLACE "\\..*" "" low "${ours}")
    math(EXPR high "${low} + 6")
    math(EXPR low "${low} - 2")
    if (ours LESS 5 OR theirs LESS low OR theirs GREATER high)
      message(FATAL_ERROR "${ours} % of our pixels show the surface, ${theirs} % of those of ${who}.")
    endif ()
  endforeach ()
  check_table("cold start ${isovalue}" 5 "ms")
  check_table("whole frame ${isovalue}" 4 "ms")
  check_table("simulated scaling ${isovalue}" 3 "efficiency, %")
endforeach ()
check_table("parker 1998 table I" 2 "traversal and intersection, %" "shading, %"
  "frames per second")
check_table("parker 1998 table II" 4 "frames per second" "speed-up")
check_table("parker 1998 table III" 8 "initial" "bricking" "hierarchy and bricking" "defaults")
check_table("other hierarchies" 11 "cold, ms" "trace, ms" "times the defaults'")
check_table("other bricks" 10 "macrocells, % of the data" "cold, ms" "trace, ms")
check_table("extraction" 4 "triangles" "s" "MiB")
check_table("growth" 2 "n" "trace, ms" "cold start to first picture, ms" "flying edges, ms")
check_table("growth fits" 3)
string(JSON count LENGTH "${json}" goals)
if (NOT count EQUAL goals OR markdown MATCHES "not measured")
  message(FATAL_ERROR "${count} goals were measured, not ${goals}.")
endif ()

# Without a display, and without anything but ours.
execute_process(
  COMMAND "${CMAKE_COMMAND}" -E env --unset=DISPLAY "${BIN}/vtkIsosurfaceBenchmark"
    --input sphere.mhd --isovalue 0 --size 32 --views 1 --repeats 1 --threads 1 --json dark.json
  WORKING_DIRECTORY "${WORK}" RESULT_VARIABLE result OUTPUT_VARIABLE out ERROR_VARIABLE err)
if (NOT result EQUAL 0 OR NOT out MATCHES "absent: gpu, because there is no display" OR
    NOT out MATCHES "this mapper \\| 1 \\| [0-9]")
  message(FATAL_ERROR "Without a display: ${out} ${err}")
endif ()
