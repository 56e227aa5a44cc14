# Tests of the example phantom: cmake -D CASE=grasp|session|errors|window -D ... -P check.cmake
file(REMOVE_RECURSE ${DIR})
file(MAKE_DIRECTORY ${DIR}/a ${DIR}/b)

# run(<code> <argument>...): the program must exit with that code; `output` holds its text.
macro(run code)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output
    WORKING_DIRECTORY ${DIR})
  message("${output}")
  if(NOT result STREQUAL ${code})
    message(FATAL_ERROR "exit code ${result} instead of ${code}")
  endif()
endmacro()

function(must_print)
  foreach(wanted ${ARGN})
    if(NOT output MATCHES "${wanted}")
      message(FATAL_ERROR "not printed: ${wanted}")
    endif()
  endforeach()
endfunction()

# Checks the number of pictures, and that over a tenth of the last one differs from its corner pixel.
function(must_be_pictures count)
  file(GLOB frames ${ARGN}/frame_*.ppm)
  list(LENGTH frames found)
  if(NOT found EQUAL count)
    message(FATAL_ERROR "${found} pictures instead of ${count}")
  endif()
  list(POP_BACK frames last)
  file(READ ${last} bytes HEX)
  string(LENGTH "${bytes}" whole)
  math(EXPR corner "${whole} - 6")
  string(SUBSTRING "${bytes}" ${corner} 6 pixel)
  string(REPLACE "${pixel}" "" rest "${bytes}")
  string(LENGTH "${rest}" rest)
  math(EXPR tenths "10 * ${rest} / ${whole}")
  if(tenths LESS 1)
    message(FATAL_ERROR "${last} has one colour")
  endif()
endfunction()

set(unattended ${PHANTOM} --driver replay --headless --dt 0.004)
if(CASE STREQUAL "grasp")
  set(command ${unattended} --script ${RECORDINGS}/grasp_a2.txt --seconds 6.3 --keys "0:a")
  run(0 ${command} --frames a --every 1)
  set(first "${output}")
  # the pull comes to rest at 1.74 N and overshoots slightly before
  must_print("grasps node [0-9]+ of A2" "releases it; 1\\.7[0-9] N at most"
    "peak force 1\\.7[0-9] N, orifice 0\\.0 mm2 before, 0\\.0 after, 7 frames")
  must_be_pictures(7 ${DIR}/a)
  run(0 ${command} --frames b --every 1)
  if(NOT output STREQUAL first)
    message(FATAL_ERROR "the second run differs")
  endif()
  file(GLOB names RELATIVE ${DIR}/a ${DIR}/a/*)
  foreach(name ${names})
    file(SHA256 ${DIR}/a/${name} one)
    file(SHA256 ${DIR}/b/${name} other)
    if(NOT one STREQUAL other)
      message(FATAL_ERROR "${name} differs in the second run")
    endif()
  endforeach()
elseif(CASE STREQUAL "session")
  run(0 ${unattended} --script ${RECORDINGS}/session.txt --seconds 17.5 --every 5 --frames a
    --keys "0:a 5.5:3 10.8:  10.9:a 11:5 13.2:6 15.3:d 15.9:m 16:o 16.6:m 16.7:u 16.8:r 16.9:u \
16.95:u 17:s 17.2:w 17.3:c")
  must_print("grasps node [0-9]+ of A2.*the hand pushes with a ball"
    "off \\(a program\\): key a arms again\n *10\\.90[0-9] s  armed.*releases it; [0-9.]+ N"
    "the hand feels a chord.*selects chord A2/7, feels 0\\.[5-7]"
    "the hand drags a chord.*Shorten chord A2/7 to [12][0-9.]+ mm"
    "Scale the annulus to 115 %.*measure; orifice [1-9].*Sew in ring.*measure; orifice 0\\.0"
    "Sew in.*undo; .*redo; .*undo; .*undo; orifice 0\\.0 mm2"
    "save the valve.*write the plan")
  must_be_pictures(4 ${DIR}/a)
  foreach(file phantom.obj phantom.json)
    if(NOT EXISTS ${DIR}/${file})
      message(FATAL_ERROR "${file} was not written")
    endif()
  endforeach()
  if(MVS)
    run(0 ${MVS} generate -o valve.obj)
    run(0 ${MVS} plan replay phantom.json --on valve.obj)
    must_print("the result of the plan, bit for bit")
  endif()
elseif(CASE STREQUAL "errors")
  run(1 ${PHANTOM} --driver nothing --headless --seconds 1)
  must_print("^phantom: .*nothing")
  run(1 ${unattended} --seconds 1 --valve nowhere.obj)
  must_print("^phantom: .*nowhere\\.obj")
  run(1 ${unattended} --seconds 1 --script nowhere.txt)
  must_print("^phantom: .*nowhere\\.txt")
  run(1 ${unattended} --seconds 1 --script ${RECORDINGS}/circle.txt --frames nowhere)
  must_print("nowhere/frame_0000\\.ppm cannot be written")
  run(2 ${unattended} --seconds 1 --keys later:u)
  must_print("not a list of TIME:KEY: later:u" "use: phantom .*replay")
  run(2 ${unattended})
  must_print("needs --seconds or --script")
  # the end of a recording is not an error
  run(0 ${unattended} --script ${RECORDINGS}/circle.txt)
  must_print("peak force 0.00 N")
elseif(CASE STREQUAL "window")
  # on a real clock a busy machine may show only a part of the recording
  run(0 ${XVFB_RUN} -a ${PHANTOM} --driver replay --script ${RECORDINGS}/grasp_a2.txt --seconds 2
    --frames a --every 10 --keys "0:a 0.5:c")
  must_print("peak force")
  must_be_pictures(1 ${DIR}/a)
endif()
