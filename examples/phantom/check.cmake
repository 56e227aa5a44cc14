# The tests of the example phantom: cmake -D CASE=grasp|session|errors|window -D ... -P check.cmake
file(REMOVE_RECURSE ${DIR})
file(MAKE_DIRECTORY ${DIR}/a ${DIR}/b)

# run(<code> <argument>...): the program has to end with that code; its text is in `said`.
macro(run code)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE said ERROR_VARIABLE said
    WORKING_DIRECTORY ${DIR})
  message("${said}")
  if(NOT result STREQUAL ${code})
    message(FATAL_ERROR "ended with ${result}, not with ${code}")
  endif()
endmacro()

function(must_say)
  foreach(wanted ${ARGN})
    if(NOT said MATCHES "${wanted}")
      message(FATAL_ERROR "did not say: ${wanted}")
    endif()
  endforeach()
endfunction()

# There are so many pictures, and more than a tenth of the last is something else than the pixel in
# its corner.
function(must_be_pictures count)
  file(GLOB frames ${ARGN}/frame_*.ppm)
  list(LENGTH frames found)
  if(NOT found EQUAL count)
    message(FATAL_ERROR "${found} pictures in place of ${count}")
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
    message(FATAL_ERROR "${last} is of one colour")
  endif()
endfunction()

set(unattended ${PHANTOM} --driver replay --headless --dt 0.004)
if(CASE STREQUAL "grasp")
  set(command ${unattended} --script ${RECORDINGS}/grasp_a2.txt --seconds 6.3 --keys "0:a")
  run(0 ${command} --frames a --every 1)
  set(first "${said}")
  # 1.74 N is what the pull comes to rest at; on its way it is a little more
  must_say("grasps node [0-9]+ of A2" "lets go; 1\\.7[0-9] N at most"
    "peak force 1\\.7[0-9] N, orifice 0\\.0 mm2 before, 0\\.0 after, 7 frames")
  must_be_pictures(7 ${DIR}/a)
  run(0 ${command} --frames b --every 1)
  if(NOT said STREQUAL first)
    message(FATAL_ERROR "the second run was another one")
  endif()
  file(GLOB names RELATIVE ${DIR}/a ${DIR}/a/*)
  foreach(name ${names})
    file(SHA256 ${DIR}/a/${name} one)
    file(SHA256 ${DIR}/b/${name} other)
    if(NOT one STREQUAL other)
      message(FATAL_ERROR "${name} is another picture in the second run")
    endif()
  endforeach()
elseif(CASE STREQUAL "session")
  run(0 ${unattended} --script ${RECORDINGS}/session.txt --seconds 17.5 --every 5 --frames a
    --keys "0:a 5.5:3 10.8:  10.9:a 11:5 13.2:6 15.3:d 15.9:m 16:o 16.6:m 16.7:u 16.8:r 16.9:u \
16.95:u 17:s 17.2:w 17.3:c")
  must_say("grasps node [0-9]+ of A2.*the hand pushes with a ball"
    "off because of a program: key a arms again\n *10\\.90[0-9] s  armed.*lets go; [0-9.]+ N"
    "the hand feels a chord.*chooses chord A2/7, feels 0\\.[5-7]"
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
    must_say("bit for bit what the plan led to")
  endif()
elseif(CASE STREQUAL "errors")
  run(1 ${PHANTOM} --driver nothing --headless --seconds 1)
  must_say("^phantom: .*nothing")
  run(1 ${unattended} --seconds 1 --valve nowhere.obj)
  must_say("^phantom: .*nowhere\\.obj")
  run(1 ${unattended} --seconds 1 --script nowhere.txt)
  must_say("^phantom: .*nowhere\\.txt")
  run(1 ${unattended} --seconds 1 --script ${RECORDINGS}/circle.txt --frames nowhere)
  must_say("nowhere/frame_0000\\.ppm cannot be written")
  run(2 ${unattended} --seconds 1 --keys later:u)
  must_say("no keys with their times: later:u" "use: phantom .*replay")
  run(2 ${unattended})
  must_say("needs --seconds or --script")
  # and no error: a recording ends by itself
  run(0 ${unattended} --script ${RECORDINGS}/circle.txt)
  must_say("peak force 0.00 N")
elseif(CASE STREQUAL "window")
  # on a real clock: how much of the recording a busy machine shows is its own affair
  run(0 ${XVFB_RUN} -a ${PHANTOM} --driver replay --script ${RECORDINGS}/grasp_a2.txt --seconds 2
    --frames a --every 10 --keys "0:a 0.5:c")
  must_say("peak force")
  must_be_pictures(1 ${DIR}/a)
endif()
