# add_readers(NAME): the readers of foreign files alone, as an object library of its own flags, for sanitizers and
# fuzzing. No OpenVDB, CGAL or Embree, so that it compiles in a minute.
function(add_readers name)
  set(lib ${PROJECT_SOURCE_DIR}/lib)
  set(sources)
  foreach(folder core io io/detail job job/detail gcode gcode/detail fdm)
    file(GLOB folder_sources CONFIGURE_DEPENDS ${lib}/aplomb/${folder}/*.cpp)
    list(APPEND sources ${folder_sources})
  endforeach()
  foreach(source balance/hanging_pose balance/hanging_rows balance/pose balance/poses balance/stability balance/hanging balance/pedestal balance/standing balance/standing_rows
                 balance/support_polygon balance/detail/contact_surface balance/detail/convex_hull_2d balance/detail/enclosing_circle mesh/placement mesh/triangle_mesh mesh/repair_options mesh/mass_properties
                 inserts/insert printability/judge_options printability/rules adapters/valijson/json_schema)
    list(APPEND sources ${lib}/aplomb/${source}.cpp)
  endforeach()
  list(FILTER sources EXCLUDE REGEX "fdm/(predict_print|layered_print|ballast)|core/threads")
  file(READ ${lib}/aplomb/job/job.schema.json APLOMB_JOB_SCHEMA)
  configure_file(${lib}/aplomb/job/job_schema.cpp.in ${CMAKE_CURRENT_BINARY_DIR}/job_schema.cpp @ONLY)
  add_library(${name} OBJECT ${sources} ${CMAKE_CURRENT_BINARY_DIR}/job_schema.cpp)
  target_include_directories(${name} PUBLIC ${lib})
  target_link_libraries(${name} PUBLIC pugixml PkgConfig::libzip nlohmann_json::nlohmann_json fmt::fmt)
endfunction()
