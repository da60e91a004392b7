# SPDX-License-Identifier: Apache-2.0
# Eight sources of a target are compiled at once, in about half the processor time. In builds without sanitizers the
# modules below are not. Tests are compiled with few optimisations, and with none where there are sanitizers: what they
# test is not, and `make test` from nothing is faster by five minutes on two cores.

# Their inner loops take most of the time of every figure in docs/. The compiler limits inlining by
# the size of what it compiles at once, so a source that is added elsewhere must not change how a loop is compiled.
set(THEATRON_FAST_MODULES image geometry codec filter video render medical)

# These decide, count and tell; a loop over pixels, as of a thumbnail, runs in them once in a while. The compiler takes
# a third less time for them with few optimisations.
set(THEATRON_LOGIC_MODULES app client demo_command host lead or_screen publish session study viewer wire)

# Inline functions of headers take most of the time of these.
set(THEATRON_LONG_TESTS registration_test synthetic_test)

# A source whose file-local names another source of its target also has is compiled alone. The compiler
# says "redefinition" or "ambiguous" then: rename one of the two, or add a source here. So is one that takes the
# compiler longest, such as each with Boost's sockets: two cores share them.
set(THEATRON_COMPILED_ALONE
  apps/theatron/host_command.cpp
  apps/theatron/join_command.cpp
  bench/theatron_bench/bench_filter.cpp
  bench/theatron_bench/bench_pipeline.cpp
  bench/theatron_bench/bench_render.cpp
  bench/theatron_bench/bench_slices.cpp
  bench/theatron_bench/bench_video.cpp
  bench/theatron_bench/bench_view_scene.cpp
  bench/theatron_bench/bench_web.cpp
  bench/theatron_bench/browser_page.cpp
  src/window/x11_window_native.cpp
  src/capture/camera.cpp
  src/capture/mkv_answer.cpp
  src/capture/mkv_answer_test.cpp
  src/capture/mkv_camera.cpp
  src/capture/mkv_camera_test.cpp
  src/capture/mkv_file.cpp
  src/capture/mkv_reader.cpp
  src/capture/readable_file.cpp
  src/capture/recording_damage_test.cpp
  src/capture/transport_test.cpp
  src/capture/video_camera.cpp
  src/capture/video_reader.cpp
  src/capture/watched_camera_test.cpp
  src/cases/foreign_files.cpp
  src/cases/manifest.cpp
  src/cases/nrrd.cpp
  src/cases/real_case_test.cpp
  src/cases/share_case.cpp
  src/cases/synth_test.cpp
  src/client/settings.cpp
  src/codec/byte_decompressors.cpp
  src/codec/depth_stream_test.cpp
  src/codec/strata.cpp
  src/filter/chain_settings_test.cpp
  src/filter/cuda_chain_test.cpp
  src/filter/promises_test.cpp
  src/furniture/cabinets.cpp
  src/furniture/furnish.cpp
  src/furniture/lamps.cpp
  src/furniture/machines.cpp
  src/furniture/table.cpp
  src/furniture/wall.cpp
  src/host/filter_choice.cpp
  src/host/host.cpp
  src/host/place_watch.cpp
  src/host/thumbnail.cpp
  src/medical/mesh_shaping.cpp
  src/medical/shared_case.cpp
  src/medical/volume.cpp
  src/net/boost.cpp
  src/net/client.cpp
  src/net/connection.cpp
  src/net/door.cpp
  src/net/link_test.cpp
  src/net/sha256.cpp
  src/net/tcp_path.cpp
  src/net/way_to_host.cpp
  src/record/intake_test.cpp
  src/record/remarks.cpp
  src/record/segment_info.cpp
  src/record/stream_gate.cpp
  src/registration/lattice_fit.cpp
  src/registration/registration_report.cpp
  src/registration/rig_watch.cpp
  src/registration/rig_watch_test.cpp
  src/registration/surface_refinement.cpp
  src/registration/surface_refinement_test.cpp
  src/registration/touched_corners.cpp
  src/render/cloud_set_test.cpp
  src/render/depth_offsets.cpp
  src/render/golden_test.cpp
  src/render/picture_quality_test.cpp
  src/render/room_picture.cpp
  src/render/room_picture_test.cpp
  src/room/pointers.cpp
  src/room/teleport_marks.cpp
  src/room/virtual_room.cpp
  src/room/virtual_room_test.cpp
  src/send/camera_lane_test.cpp
  src/send/lane_encoders_test.cpp
  src/send/lane_memory_test.cpp
  src/session/mark_room_test.cpp
  src/session/pose_board_test.cpp
  src/session/request_budget_test.cpp
  src/session/room_messages_test.cpp
  src/session/room_test.cpp
  src/session/session_of_many_test.cpp
  src/session/setting_table_test.cpp
  src/synthetic/sensor_color.cpp
  src/synthetic/tray.cpp
  src/video/h264_test.cpp
  src/video/jpeg_decoder_test.cpp
  src/video/jpeg_encoder_native.cpp
  src/video/x264_native.cpp
  src/viewer/meeting.cpp
  src/viewer/monitor.cpp
  src/wire/control.cpp
  src/pace/drawing_rest_test.cpp
  src/window/overlay_native.cpp
)

# Options, JSON and handshakes: what they do takes no time, and the compiler takes the longest of all with them.
set(THEATRON_COMPILED_QUICKLY src/net/client.cpp src/net/door.cpp src/net/https_get.cpp
  src/net/way_to_host.cpp)

# theatron_compile_together(TARGET SOURCE...): the sources of TARGET, but for those of the lists above.
function(theatron_compile_together target)
  if(NOT ARGN)
    return()
  endif()
  string(REGEX REPLACE "^theatron_" "" module ${target})
  if(NOT THEATRON_SANITIZE AND module IN_LIST THEATRON_FAST_MODULES)
    return()
  endif()
  if(target MATCHES "_test$")
    if(THEATRON_SANITIZE)
      if(NOT target IN_LIST THEATRON_LONG_TESTS)
        target_compile_options(${target} PRIVATE $<$<COMPILE_LANGUAGE:CXX>:-O0>)
      endif()
    else()
      target_compile_options(${target} PRIVATE $<$<AND:$<CONFIG:Release>,$<COMPILE_LANGUAGE:CXX>>:-O1>)
    endif()
    if(THEATRON_FUZZ)
      # The fuzzer's coverage is of the modules only.
      target_compile_options(${target} PRIVATE -fno-sanitize=fuzzer-no-link)
    endif()
  endif()
  if(module IN_LIST THEATRON_LOGIC_MODULES AND NOT EMSCRIPTEN)
    target_compile_options(${target} PRIVATE $<$<AND:$<CONFIG:Release>,$<COMPILE_LANGUAGE:CXX>>:-O1>)
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
  # A name of one source shadows no name of another, and no class of a header is of one source only. GCC 12 takes
  # writes that std::vector makes for writes beyond its end where it inlines more of them, as it does in large sources.
  target_compile_options(${target} PRIVATE
    $<$<CXX_COMPILER_ID:GNU>:-Wno-shadow;-Wno-array-bounds;-Wno-stringop-overflow;-Wno-stringop-overread;-Wno-maybe-uninitialized;-Wno-subobject-linkage>)
  foreach(source ${ARGN})
    file(RELATIVE_PATH path ${CMAKE_SOURCE_DIR} ${source})
    if(path IN_LIST THEATRON_COMPILED_ALONE OR path IN_LIST THEATRON_COMPILED_QUICKLY)
      set_source_files_properties(${source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    endif()
    if(path IN_LIST THEATRON_COMPILED_QUICKLY)
      set_property(SOURCE ${source} APPEND PROPERTY COMPILE_OPTIONS $<$<CONFIG:Release>:-O1>)
    endif()
  endforeach()
endfunction()
