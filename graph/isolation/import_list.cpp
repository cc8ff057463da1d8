#include "graph/isolation/import_list.h"

#include <algorithm>
#include <cctype>
#include <span>
#include <string_view>

#include "graph/isolation/names.h"
#include "graph/math/names.h"

namespace jarol::isolation {
namespace {

struct Entry {
  const char* names;  // with spaces before, between and after
  const char* why;
};

// C functions. Each works on its arguments alone, but for `errno`, which no task can read.
constexpr Entry functions[] = {
    {" acos acosh asin asinh atan atan2 atanh cbrt ceil copysign cos cosh erf erfc exp exp10 exp2 expm1 fabs fdim "
     "floor "
     "fma fmax fmin fmod frexp hypot ilogb ldexp llrint llround log log10 log1p log2 logb lrint lround modf nan "
     "nearbyint nextafter nexttoward pow remainder remquo rint round roundeven scalbln scalbn sin sincos sinh sqrt tan "
     "tanh tgamma trunc ",
     "mathematics: a function of its arguments"},
    {" cabs carg cacos cacosh casin casinh catan catanh ccos ccosh cexp cimag clog conj cpow cproj creal csin csinh "
     "csqrt "
     "ctan ctanh ",
     "mathematics of complex numbers: a function of its arguments"},
    {" abs labs llabs div ldiv lldiv __muldc3 __mulsc3 __divdc3 __divsc3 __mulxc3 __divxc3 __powidf2 __powisf2 "
     "__powixf2 "
     "__multi3 "
     "__divti3 __modti3 __udivti3 __umodti3 __divmodti4 __udivmodti4 __floattidf __floatuntidf __floattisf "
     "__floatuntisf __floattixf __floatuntixf __fixxfti __fixunsxfti __extendhfsf2 __truncsfhf2 __truncdfhf2 __fixdfti "
     "__fixunsdfti __fixsfti __fixunssfti __popcountdi2 __clzdi2 __ctzdi2 ",
     "arithmetic that the compiler has no instruction for"},
    {" memcpy memmove memset memcmp bcmp memchr memrchr mempcpy strlen strnlen strcmp strncmp strncpy strchr strrchr "
     "__memcpy_chk __memmove_chk __memset_chk __mempcpy_chk ",
     "memory and text: works on what it is given"},
    {" __cxa_allocate_exception __cxa_free_exception __cxa_throw __cxa_rethrow __cxa_begin_catch __cxa_end_catch "
     "__cxa_get_exception_ptr __cxa_init_primary_exception __cxa_throw_bad_array_new_length __cxa_bad_cast "
     "__cxa_bad_typeid __cxa_call_unexpected __dynamic_cast __gxx_personality_v0 _Unwind_Resume ",
     "exceptions and casts: what is thrown belongs to the thread that runs the task, until it is caught"},
    {" abort __assert_fail __cxa_pure_virtual __cxa_deleted_virtual __stack_chk_fail __chk_fail ",
     "ends the process at once, and with it the run"},
};

// The first of them: there is one of each for float, double and long double.
constexpr std::span mathematics = std::span(functions).first<2>();

// What C or IEEE 754 define to the bit, or what only picks a part.
constexpr std::string_view exact =
    " ceil cimag conj copysign cproj creal drem fabs fdim floor fma fmax fmin fmod frexp ilogb ldexp llrint llround "
    "logb "
    "lrint lround modf nan nearbyint nextafter nexttoward remainder remquo rint round roundeven scalbln scalbn sqrt "
    "trunc ";

// Tasks may not call these, or must be weak.
constexpr std::string_view more_mathematics =
    " gamma j0 j1 jn lgamma lgamma_r lgammaf_r lgammal_r pow10 scalb significand y0 y1 yn ";

// C++ functions and objects as they stand in the source; with * whatever follows.
constexpr Entry declarations[] = {
    {"|std::terminate()|std::__glibcxx_assert_fail*|std::__replacement_assert*|",
     "ends the process at once, and with it the run"},
    {"|operator delete*|",
     "gives back what `operator new` gave, which is refused; every table of virtual functions names it"},
    {"|std::__throw_*|std::exception::*|std::bad_exception::*|std::bad_alloc::*|std::bad_cast::*|std::bad_typeid::*|"
     "std::bad_array_new_length::*|std::logic_error::*|std::domain_error::*|std::invalid_argument::*|"
     "std::length_error::*|std::out_of_range::*|std::runtime_error::*|std::range_error::*|std::overflow_error::*|"
     "std::underflow_error::*|std::bad_function_call::*|std::bad_optional_access::*|std::bad_variant_access::*|"
     "vtable for std::exception|vtable for std::bad_*|vtable for std::*_error|vtable for std::invalid_argument|"
     "vtable for std::out_of_range|",
     "the standard exceptions, which keep their text in memory of their own"},
    {"|typeinfo for *|typeinfo name for *|vtable for __cxxabiv1::*|std::type_info::*|", "what a type is, a constant"},
    {"|std::from_chars*|std::to_chars*|std::__detail::__*_from_chars*|", "numbers to text and back, by no locale"},
    {"|std::_Hash_bytes*|std::_Fnv_hash_bytes*|std::__detail::_Prime_rehash_policy::*|std::__detail::__prime_list|"
     "std::_Rb_tree_*|std::__detail::_List_node_base::*|",
     "the parts of containers that do not allocate"},
    {"|std::pmr::monotonic_buffer_resource::*|std::pmr::unsynchronized_pool_resource::*|"
     "std::pmr::memory_resource::*|std::pmr::null_memory_resource()|vtable for std::pmr::monotonic_buffer_resource|"
     "vtable for std::pmr::unsynchronized_pool_resource|vtable for std::pmr::memory_resource|",
     "allocates from what the task gives it; the global allocator is reached by its name only"},
    {"|std::nothrow|std::ignore|std::piecewise_construct|std::placeholders::_*|", "an empty constant"},
};

// Jarol's own: what a task's form and values of changing size call.
constexpr Entry own_functions[] = {
    {"|jarol::require_default_floating_point()|jarol::restore_floating_point()|jarol::keep_text(*|",
     "how the runtime contains what a task throws"},
    {"|__cxa_allocate_exception|__cxa_end_catch|", "exceptions, as the command passes them on to the C++ library"},
    {"|jarol::detail::throw_no_element(*|", "throws a standard exception, which keeps its text in memory of its own"},
    {"|jarol::memory_of_now()|jarol::no_heap()|jarol::PrivateHeap::block_size(*|jarol::HeapExhausted::*|"
     "vtable for jarol::HeapExhausted|jarol::PrivateHeap::Values::*|jarol::PrivateHeap::Scratch::*|",
     "the task's own heap and scratch"},
};

struct Refused {
  const char* names;
  const char* kind;
};

constexpr Refused refused_functions[] = {
    {" time clock clock_gettime clock_getres clock_nanosleep clock_settime gettimeofday times timespec_get ftime "
     "nanosleep sleep usleep localtime localtime_r gmtime gmtime_r mktime strftime difftime tzset alarm setitimer "
     "timer_create ",
     "a clock"},
    {" fopen fopen64 fdopen freopen fclose fread fwrite fprintf printf puts putchar putc fputs fputc fgets fgetc getc "
     "getchar getline scanf fscanf vprintf vfprintf perror fflush fseek ftell rewind remove rename tmpfile open open64 "
     "openat creat close read write pread pwrite readv writev lseek stat fstat lstat access unlink mkdir rmdir opendir "
     "readdir closedir chdir getcwd dup dup2 pipe pipe2 fcntl ioctl poll ppoll select epoll_create epoll_create1 "
     "epoll_ctl epoll_wait mmap munmap mprotect msync ftruncate fsync stdin stdout stderr __printf_chk __fprintf_chk "
     "__vfprintf_chk __open_2 syslog sync sendfile shm_open mkstemp ",
     "a file or stream"},
    {" socket bind listen accept accept4 connect send sendto sendmsg recv recvfrom recvmsg shutdown setsockopt "
     "getsockopt getaddrinfo gethostbyname getpeername socketpair inet_addr ",
     "a socket"},
    {" fork vfork clone execve execv execvp execl execlp system popen wait waitpid kill getpid getppid gettid getuid "
     "exit _exit _Exit quick_exit at_quick_exit atexit __cxa_atexit on_exit posix_spawn prctl ptrace sysconf uname "
     "gethostname getrusage getrlimit setrlimit sysinfo syscall ",
     "a process or the system"},
    {" pthread_create pthread_join pthread_detach pthread_self pthread_once pthread_key_create pthread_getspecific "
     "pthread_setspecific sched_yield sched_getcpu sched_setaffinity sched_getaffinity __libc_single_threaded "
     "__pthread_key_create thrd_create ",
     "a thread"},
    {" rand srand random srandom rand_r drand48 erand48 lrand48 mrand48 srand48 getrandom getentropy arc4random "
     "arc4random_uniform ",
     "random numbers"},
    {" getenv secure_getenv setenv unsetenv putenv clearenv environ __environ getauxval program_invocation_name ",
     "the environment"},
    {" setlocale localeconv newlocale uselocale freelocale strtod strtof strtold strtol strtoul strtoll strtoull atof "
     "atoi atol sprintf snprintf vsnprintf __snprintf_chk __vsnprintf_chk __sprintf_chk sscanf isalpha isdigit isspace "
     "toupper tolower __ctype_b_loc __ctype_toupper_loc __ctype_tolower_loc strcoll wcstombs mbstowcs strerror ",
     "the locale"},
    {" signal sigaction raise sigprocmask sigaltstack sigwait psignal siglongjmp sigsetjmp __sigsetjmp ", "a signal"},
    {" fesetround fegetround fesetenv fegetenv feholdexcept feupdateenv feclearexcept feraiseexcept fetestexcept "
     "fegetexceptflag fesetexceptflag feenableexcept fedisableexcept fegetexcept fesetmode fegetmode ",
     "the floating-point environment"},
    {" dlopen dlsym dlvsym dlclose dlmopen dladdr dladdr1 dlinfo dlerror dl_iterate_phdr ", "the dynamic loader"},
    {" setjmp _setjmp longjmp _longjmp __longjmp_chk getcontext setcontext makecontext swapcontext ",
     "a jump past the end of functions"},
    {" malloc calloc realloc reallocarray free aligned_alloc posix_memalign memalign valloc strdup strndup brk sbrk "
     "mallopt malloc_usable_size qsort ",
     "the global allocator"},
    {" __cxa_guard_acquire __cxa_guard_release __cxa_guard_abort ", "a function-local static"},
    {" __cxa_thread_atexit __cxa_thread_atexit_impl __tls_get_addr __errno_location ", "thread-local storage"},
    {" lgamma lgammaf lgammal gamma gammaf signgam strtok srandom_r hcreate hsearch ",
     "a writable global of the C library"},
    {" __cxa_get_globals __cxa_get_globals_fast __cxa_current_exception_type __cxa_current_primary_exception "
     "_Unwind_Backtrace _Unwind_RaiseException _Unwind_ForcedUnwind backtrace ",
     "the state of exceptions"},
    {" __cpu_model __cpu_indicator_init __cpu_features2 ", "what processor this is"},
};

constexpr Refused refused_beginnings[] = {
    {"|operator new|std::get_new_handler|std::set_new_handler|std::__cxx11::basic_string|std::basic_string|"
     "std::pmr::new_delete_resource|std::pmr::get_default_resource|std::pmr::set_default_resource|"
     "std::get_temporary_buffer|std::allocator|",
     "the global allocator"},
    {"|std::chrono::|std::this_thread::|", "a clock"},
    {"|std::thread|std::jthread|std::condition_variable|std::__future_base|std::future|std::promise|std::call_once|"
     "std::once_flag|std::__once_|std::execution|std::async|",
     "a thread"},
    {"|std::mutex|std::_V2::|std::__throw_system_error|std::__atomic|std::pmr::synchronized_pool_resource|", "a lock"},
    {"|std::random_device|", "random numbers"},
    {"|std::cout|std::cerr|std::clog|std::cin|std::wcout|std::wcerr|std::basic_ostream|std::basic_istream|"
     "std::basic_iostream|std::ostream|std::istream|std::basic_filebuf|std::basic_ifstream|std::basic_ofstream|"
     "std::basic_fstream|std::basic_streambuf|std::basic_ios|std::ios_base|std::filesystem|std::endl|std::flush|"
     "std::__ostream_insert|std::__basic_file|std::__cxx11::basic_stringbuf|std::__cxx11::basic_ostringstream|"
     "std::__cxx11::basic_stringstream|std::__cxx11::basic_istringstream|std::operator<<|std::operator>>|vtable for "
     "std::basic_|"
     "vtable for std::__cxx11::basic_|VTT for std::|std::getline|",
     "a file or stream"},
    {"|std::locale|std::use_facet|std::has_facet|std::ctype|std::num_put|std::num_get|std::regex|std::__cxx11::regex|",
     "the locale"},
    {"|std::uncaught_exception|std::current_exception|std::rethrow_exception|std::__exception_ptr|std::get_terminate|"
     "std::set_terminate|std::nested_exception|",
     "the state of exceptions"},
    {"|pthread_mutex|pthread_rwlock|pthread_spin|pthread_cond|pthread_barrier|sem_|mtx_|cnd_|__gthread|", "a lock"},
    {"|pthread_|thrd_|", "a thread"},
    {"|sig|", "a signal"},
    {"|jarol::set_floating_point_control|jarol::floating_point_control|", "the floating-point environment"},
    {"|jarol::|", "a part of Jarol that is not for tasks"},
};

bool holds_word(std::string_view list, const std::string& word) {
  return list.find(" " + word + " ") != std::string_view::npos;
}

// Is a declaration one of the patterns between bars? A pattern alone is a beginning where `as_beginning`.
bool matches_any(std::string_view patterns, std::string_view declaration, bool as_beginning) {
  for (std::size_t at = 1; at < patterns.size();) {
    const std::size_t end = patterns.find('|', at);
    const std::string_view pattern = patterns.substr(at, end - at);
    at = end + 1;
    const std::size_t star = pattern.find('*');
    if (star == std::string_view::npos) {
      if (as_beginning ? declaration.starts_with(pattern) : declaration == pattern) return true;
      continue;
    }
    const std::string_view before = pattern.substr(0, star), after = pattern.substr(star + 1);
    if (declaration.size() >= before.size() + after.size() && declaration.starts_with(before) &&
        (after.empty() || declaration.find(after, before.size()) != std::string_view::npos))
      return true;
  }
  return false;
}

// Without the type that a function template returns.
std::string declaration_of(const std::string& name) {
  std::string text = demangled(name);
  int depth = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '<') ++depth;
    if (text[i] == '>') --depth;
    if (text[i] == '(') break;
    if (text[i] == ' ' && depth == 0 && i + 1 < text.size() && !text.starts_with("operator ") &&
        !text.starts_with("vtable ") && !text.starts_with("typeinfo ") && !text.starts_with("VTT "))
      return text.substr(i + 1);
  }
  return text;
}

// A function of the C library for doubles stands for those for float and long double.
std::string for_double(const std::string& name) {
  const bool other = name.size() > 1 && (name.back() == 'f' || name.back() == 'l');
  return other ? name.substr(0, name.size() - 1) : name;
}

}  // namespace

bool is_own_library(const std::string& name) {
  const std::string declaration = declaration_of(name);
  return std::any_of(std::begin(own_functions), std::end(own_functions),
                     [&](const Entry& entry) { return matches_any(entry.names, declaration, false); });
}

std::string reason_for(const std::string& name) {
  if (!kind_of_refused(name).empty() && !is_own_library(name)) return "";
  if (name.starts_with("_Z")) {
    const std::string declaration = declaration_of(name);
    for (const std::span<const Entry> list :
         {std::span<const Entry>(declarations), std::span<const Entry>(own_functions)})
      for (const Entry& entry : list)
        if (matches_any(entry.names, declaration, false)) return entry.why;
    return "";
  }
  for (const Entry& entry : functions)
    if (holds_word(entry.names, name)) return entry.why;
  for (const Entry& entry : mathematics)
    if (holds_word(entry.names, for_double(name))) return entry.why;
  return "";
}

bool is_mathematics(const std::string& name) {
  return std::any_of(mathematics.begin(), mathematics.end(), [&](const Entry& entry) {
    return holds_word(entry.names, name) || holds_word(entry.names, for_double(name));
  });
}

bool is_of_c_library(const std::string& name) {
  const std::string plain = for_double(name);
  const bool is_more = holds_word(more_mathematics, name) || holds_word(more_mathematics, plain);
  if (!is_more && !is_mathematics(name)) return false;
  if (holds_word(exact, name) || holds_word(exact, plain)) return false;
  const auto ours = math::names();
  return std::none_of(ours.begin(), ours.end(), [&](const math::Named& one) { return one.name == name; });
}

std::string kind_of_refused(const std::string& name) {
  for (const Refused& refused : refused_functions)
    if (holds_word(refused.names, name)) return refused.kind;
  const std::string declaration = declaration_of(name);
  for (const Refused& refused : refused_beginnings)
    if (matches_any(refused.names, declaration, true)) return refused.kind;
  return "";
}

}  // namespace jarol::isolation
