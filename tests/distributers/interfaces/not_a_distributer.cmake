# Compiles not_a_distributer.cpp with one of its cases and looks what the compiler says: cmake -DNUMBER=1 -DCOMPILER=c++
# -DROOT=tree -DMADE=folder -DEIGEN=folder -P not_a_distributer.cmake
cmake_minimum_required(VERSION 3.25)
set(says_1 "a channel of In is a Newest<T>, which messages bring, or a Computed<T>")
set(says_2 "a distributer has a static message_set\\(\\) that returns the messages::MessageSet it speaks")
set(says_3 "each channel of Out needs one send<&Out::x>\\(...\\) in handlers\\(\\)")
set(says_4 "a message has one handler, one on<M>\\(...\\)")
set(says_5 "on<M>\\(...\\): M is a message of a message set, as messages::imc::Depth")
set(says_6 "the handler of on<M> is called with the distributer and a const M&")
set(says_7 "the handler of send<&Out::x> is called with the distributer, the value and a messages::Receiver&")
set(says_8 "a distributer's reach is called as reach\\(Duration instant, messages::Receiver& system\\)")
set(says_9 "a distributer has a public member `In in`, which its handlers write")

execute_process(COMMAND ${COMPILER} -std=c++20 -fsyntax-only -DCASE=${NUMBER} -I ${ROOT} -I ${MADE} -isystem ${EIGEN}
  ${ROOT}/tests/distributers/interfaces/not_a_distributer.cpp ERROR_VARIABLE said OUTPUT_VARIABLE said
  RESULT_VARIABLE failed)
if(NUMBER EQUAL 0)
  if(failed)
    message(FATAL_ERROR "what is a distributer does not compile:\n${said}")
  endif()
elseif(NOT said MATCHES "${says_${NUMBER}}")
  message(FATAL_ERROR "the compiler does not say '${says_${NUMBER}}':\n${said}")
endif()
