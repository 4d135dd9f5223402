# The wire contract as a coming minor version may have it, for the tests of versions:
#   cmake -DIDL=idl/bleed.idl -DOUTPUT=bleed.idl -P write_next_idl.cmake
# Each @appendable struct gets a number, a text and a sequence at its end, each union a new case, PROTOCOL_MINOR rises by one and
# there is a request that the present version does not know.
cmake_minimum_required(VERSION 3.25)
file(READ "${IDL}" text)
string(REGEX REPLACE "//[^\n]*" "" text "${text}") # comments may hold braces

if(NOT text MATCHES "PROTOCOL_MINOR = ([0-9]+)")
  message(FATAL_ERROR "${IDL} has no PROTOCOL_MINOR: keep write_next_idl.cmake in step with it")
endif()
math(EXPR minor "${CMAKE_MATCH_1} + 1")
string(REGEX REPLACE "PROTOCOL_MINOR = [0-9]+" "PROTOCOL_MINOR = ${minor}" text "${text}")

# A body ends at the first brace: no type of the contract holds another.
set(members "unsigned long long next_number; string<16> next_text; sequence<double> next_values; ")
string(REGEX REPLACE "(@appendable[^{}]*struct [A-Za-z]+ {[^}]*)}" "\\1 ${members}}" grown "${text}")
string(REGEX REPLACE "(@appendable[^{}]*union [A-Za-z]+ switch [^{]*{[^}]*)}" "\\1 case 9999: NextNews next_news; }" grown "${grown}")
string(REPLACE "typedef octet Uuid[16];"
  "typedef octet Uuid[16];\n  @appendable @nested struct NextNews { unsigned long long number; string<16> text; };\n  const unsigned long REQUEST_NEXT = 9999;"
  grown "${grown}")

string(REGEX MATCHALL "@appendable" had "${text}")
string(REGEX MATCHALL "next_number|next_news" has "${grown}")
list(LENGTH had had)
list(LENGTH has has)
if(NOT had EQUAL has OR NOT grown MATCHES "struct NextNews")
  message(FATAL_ERROR "${has} of ${had} appendable types of ${IDL} have grown: keep write_next_idl.cmake in step with it")
endif()
file(WRITE "${OUTPUT}" "${grown}")
