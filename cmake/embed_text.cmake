# Writes OUT: C++ that defines NAME, a string_view of namespace NAMESPACE, as the text of FILE. Run with cmake -P.
file(READ ${FILE} text)
get_filename_component(file_name ${FILE} NAME)
file(WRITE ${OUT} "// Generated from ${file_name}; do not edit.\n#include <string_view>\n\nnamespace ${NAMESPACE} {\n\n")
file(APPEND ${OUT} "extern const std::string_view ${NAME};\nconst std::string_view ${NAME} = R\"text(${text})text\";\n\n}  // namespace ${NAMESPACE}\n")
