# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
# Writes OUTPUT, a source with a digest of SOURCES, a list of files.
set(digests "")
foreach(file ${SOURCES})
  file(SHA256 ${file} digest)
  string(APPEND digests ${digest})
endforeach()
string(SHA256 digest "${digests}")
string(SUBSTRING ${digest} 0 16 digest)
file(WRITE ${OUTPUT} "#include \"engine/keep/keep_options.h\"\n
const char* mw::engine::results_id() {\n  return \"${digest}\";\n}\n")
