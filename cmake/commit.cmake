# Writes OUTPUT, the source that defines fpi::commit: the commit that is checked out in SOURCE, "" outside of a repository.
execute_process(COMMAND git -C ${SOURCE} rev-parse --short=12 HEAD OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE
  ERROR_QUIET RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  set(commit "")
endif()
file(WRITE ${OUTPUT} "#include \"core/version.hpp\"\n\nconst char* const fpi::commit = \"${commit}\";\n")
