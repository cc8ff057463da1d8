// Tasks with instructions that no task may hold, and calls that can't be resolved.
#include "tests/isolation/task.h"

namespace {
[[gnu::used]] double far_away asm("far_away") = 0;

using Function = double (*)(double);

[[gnu::noinline]] std::uint64_t cycles() {
  std::uint32_t low, high;
  asm volatile("rdtsc" : "=a"(low), "=d"(high));
  return std::uint64_t{high} << 32 | low;
}
[[gnu::noinline]] double call_address(std::int64_t address, double x) { return reinterpret_cast<Function>(address)(x); }
[[gnu::noinline]] double half(double x) { return x / 2; }
constexpr Function halves[] = {half, half};

// offends: forbidden instruction: syscall: SystemCall::run
TASK(SystemCall, {
  long result;
  asm volatile("syscall" : "=a"(result) : "a"(39) : "rcx", "r11", "memory");
  out.out = static_cast<double>(result);
})
// offends: forbidden instruction: int: OldSystemCall::run
TASK(OldSystemCall, {
  long result;
  asm volatile("int $0x80" : "=a"(result) : "a"(20) : "memory");
  out.out = static_cast<double>(result);
})
// offends: forbidden instruction: maskmovdqu: WritesThreadLocal::run
TASK(WritesThreadLocal, {
  asm volatile(".byte 0x64\n maskmovdqu %%xmm1, %%xmm0" : : "D"(-8L) : "memory");
  out.out = 1;
})
// offends: forbidden instruction: rdtsc: Cycles::run > cycles
TASK(Cycles, { out.out = static_cast<double>(cycles()); })
// offends: forbidden instruction: rdtscp: CyclesAndCore::run
TASK(CyclesAndCore, {
  unsigned core;
  out.out = static_cast<double>(__builtin_ia32_rdtscp(&core));
})
// offends: forbidden instruction: rdrand: HardwareRandom::run
TASK(HardwareRandom, {
  unsigned long random;
  asm volatile("rdrand %0" : "=r"(random));
  out.out = static_cast<double>(random);
})
// offends: forbidden instruction: rdseed: HardwareSeed::run
TASK(HardwareSeed, {
  unsigned long random;
  asm volatile("rdseed %0" : "=r"(random));
  out.out = static_cast<double>(random);
})
// offends: forbidden instruction: rdpid: AsksCore::run
TASK(AsksCore, {
  unsigned long core;
  asm volatile("rdpid %0" : "=r"(core));
  out.out = static_cast<double>(core);
})
// offends: forbidden instruction: rdpid: AsksCoreIntoAnother::run
TASK(AsksCoreIntoAnother, {
  unsigned long core;
  asm volatile("rdpid %%r9\n mov %%r9, %0" : "=r"(core) : : "r9");
  out.out = static_cast<double>(core);
})
// offends: forbidden instruction: cpuid: AsksProcessor::run
TASK(AsksProcessor, {
  unsigned a = 0, b, c, d;
  asm volatile("cpuid" : "+a"(a), "=b"(b), "=c"(c), "=d"(d));
  out.out = a;
})
// offends: forbidden instruction: xgetbv: AsksState::run
TASK(AsksState, {
  unsigned a, d;
  asm volatile("xgetbv" : "=a"(a), "=d"(d) : "c"(0));
  out.out = a;
})
// offends: forbidden instruction: xsavec64: SavesCompact::run
TASK(SavesCompact, {
  alignas(64) char saved[4096] = {};
  asm volatile("xsavec64 %0" : "+m"(saved) : "a"(7), "d"(0));
  out.out = saved[24];
})
// offends: forbidden instruction: xsaveopt64: SavesSome::run
TASK(SavesSome, {
  alignas(64) char saved[4096] = {};
  asm volatile("xsaveopt64 %0" : "+m"(saved) : "a"(7), "d"(0));
  out.out = saved[24];
})
// offends: forbidden instruction: tpause: Pauses::run
TASK(Pauses, { asm volatile(".byte 0x66, 0x0f, 0xae, 0xf0" : : "a"(0), "d"(0) : "cc"); })
// offends: forbidden instruction: umwait: WaitsForWrite::run
TASK(WaitsForWrite, { asm volatile(".byte 0xf2, 0x0f, 0xae, 0xf0" : : "a"(0), "d"(0) : "cc"); })
TASK(OrdersMemory, {
  asm volatile("mfence" ::: "memory");
  out.out = 1;
})
// offends: forbidden instruction: rsqrtps: ApproximatesRoots::run
TASK(ApproximatesRoots, { asm("rsqrtps %1, %0" : "=x"(out.out) : "x"(in.in)); })
// offends: forbidden instruction: rcpss: ApproximatesReciprocal::run
TASK(ApproximatesReciprocal, { asm("rcpss %1, %0" : "=x"(out.out) : "x"(in.in)); })
// offends: forbidden instruction: vrsqrt14pd: ApproximatesBetter::run
TASK(ApproximatesBetter, { asm volatile("vrsqrt14pd %%zmm0, %%zmm1" ::: "xmm1"); })
// offends: forbidden instruction: fsin: OldSine::run
TASK(OldSine, {
  long double x = in.in;
  asm("fsin" : "+t"(x));
  out.out = static_cast<double>(x);
})
// offends: forbidden instruction: ldmxcsr: SetsRounding::run
TASK(SetsRounding, {
  const unsigned upward = 0x5f80;
  asm volatile("ldmxcsr %0" : : "m"(upward));
})
// offends: forbidden instruction: stmxcsr: ReadsFlags::run
TASK(ReadsFlags, {
  unsigned flags;
  asm volatile("stmxcsr %0" : "=m"(flags));
  out.out = flags;
})
// offends: forbidden instruction: fldcw: SetsOldRounding::run
TASK(SetsOldRounding, {
  const unsigned short upward = 0xb3f;
  asm volatile("fldcw %0" : : "m"(upward));
})
// offends: forbidden instruction: paddw: UsesMmx::run
TASK(UsesMmx, { asm volatile("paddw %%mm0, %%mm1" ::: "mm1"); })
// offends: forbidden instruction: ffree: FreesRegister::run
TASK(FreesRegister, { asm volatile("ffree %st(0)"); })
// offends: forbidden instruction: fincstp: TurnsRegisters::run
TASK(TurnsRegisters, { asm volatile("fincstp"); })
// offends: forbidden instruction: xlatb: LooksUpByte::run
TASK(LooksUpByte, { asm volatile("fs xlatb" ::: "rax"); })
// offends: a writable global: far_away: ReachesByDistance::run
TASK(ReachesByDistance, {
  double* place;
  asm("leaq 1f(%%rip), %0\n1: movabsq $far_away-1b, %%rcx\n addq %%rcx, %0" : "=r"(place) : : "rcx");
  out.out = *place += 1;
})
// offends: a writable global: far_away: ReachesByIndex::run
TASK(ReachesByIndex, {
  asm volatile("leaq 1f(%%rip), %%rax\n1: movabsq $far_away-1b, %%rcx\n movsd (%%rax,%%rcx), %0"
               : "=x"(out.out)
               :
               : "rax", "rcx");
})
// offends: forbidden instruction: in: TalksToDevice::run
TASK(TalksToDevice, {
  unsigned char byte;
  asm volatile("inb $0x60, %0" : "=a"(byte));
  out.out = byte;
})
// offends: the table of offsets: : HooksSine::run
TASK(HooksSine, { asm volatile("movq %0, sin@GOTPCREL(%%rip)" : : "r"(in.in) : "memory"); })
// offends: thread-local storage: : ReadsSegment::run
TASK(ReadsSegment, {
  long self;
  asm volatile("mov %%fs:0x10, %0" : "=r"(self));
  out.out = static_cast<double>(self);
})
// offends: thread-local storage: : ReadsGuard::run
TASK(ReadsGuard, {
  long random;
  asm volatile("mov %%fs:0x28, %0" : "=r"(random));
  out.out = static_cast<double>(random);
})
// offends: thread-local storage: : WritesGuard::run
TASK(WritesGuard, { asm volatile("movq $0, %%fs:0x28" ::: "memory"); })
// offends: unreadable code: : MiddleOfInstruction::run
TASK(MiddleOfInstruction, {
  asm volatile(
      "jmp 1f + 2\n"
      "1: movl $0x90050f90, %%eax\n" ::
          : "eax");
})
// offends: a call that can't be resolved: : ForgedFromInput::run
TASK(ForgedFromInput, { out.out = reinterpret_cast<Function>(in.address)(in.in); })
// offends: a call that can't be resolved: : ForgedFromState::run
TASK(ForgedFromState, {
  state.address += 16;
  out.out = reinterpret_cast<Function>(state.address)(in.in);
})
// offends: a call that can't be resolved: : ForgedBesideGood::run > call_address
TASK(ForgedBesideGood, {
  volatile Function good = half;
  out.out = good(in.in) + call_address(in.address + 1, in.in);
})
// offends: a call that can't be resolved: : ForgedTailCall::run
TASK(ForgedTailCall, {
  volatile Function good = half;
  out.out = good(in.in);
  return reinterpret_cast<void (*)()>(in.address ^ 0x55)();
})
// offends: a call that can't be resolved: : ForgedObject::run
TASK(ForgedObject, { out.out = (*reinterpret_cast<Function**>(in.address))[7](in.in); })
// offends: a call that can't be resolved: : ForgedFromTable::run
TASK(ForgedFromTable, {
  const auto table = reinterpret_cast<std::intptr_t>(&halves);
  out.out = reinterpret_cast<Function>(table + in.address)(in.in) + halves[tick.activation % 2](in.in);
})
// offends: a call that can't be resolved: : ForgedByIndex::run
TASK(ForgedByIndex, {
  std::intptr_t made;
  asm("lea (%1,%2,8), %0" : "=r"(made) : "r"(&halves), "r"(in.address));
  out.out = reinterpret_cast<Function>(made)(in.in) + halves[tick.activation % 2](in.in);
})
// offends: a call that can't be resolved: : ForgedInArray::run
TASK(ForgedInArray, {
  const std::int64_t made[] = {in.address, state.address};
  out.out = half(in.in) + reinterpret_cast<Function>(made[tick.activation & 1])(in.in);
})
// offends: a call that can't be resolved: : ForgedAmongGood::run
TASK(ForgedAmongGood, {
  const Function functions[] = {half, halves[1], reinterpret_cast<Function>(in.address), half};
  out.out = functions[tick.activation & 3](in.in);
})
// offends: a call that can't be resolved: : ForgedInLoop::run
TASK(ForgedInLoop, {
  std::int64_t made[4] = {};
  for (std::int64_t i = 0; i < 4; ++i) made[i * tick.activation & 3] = in.address + i;
  out.out = half(in.in) + reinterpret_cast<Function>(made[tick.activation & 3])(in.in);
})
// offends: a call that can't be resolved: : Numbers::run
TASK(Numbers, {
  volatile std::int64_t number = 4096;
  out.out = reinterpret_cast<Function>(number)(in.in);
})

}  // namespace

JAROL_PLUGIN(SystemCall, WritesThreadLocal, OldSystemCall, Cycles, CyclesAndCore, HardwareRandom, HardwareSeed,
             AsksCore, AsksCoreIntoAnother, AsksProcessor, AsksState, SetsRounding, ReadsFlags, SetsOldRounding,
             TalksToDevice, HooksSine, ReadsSegment, ReadsGuard, WritesGuard, MiddleOfInstruction, ForgedFromInput,
             ForgedFromState, ForgedBesideGood, ForgedTailCall, ForgedObject, ForgedFromTable, ForgedByIndex,
             ForgedInArray, ForgedAmongGood, ForgedInLoop, Numbers, UsesMmx, FreesRegister, TurnsRegisters, LooksUpByte,
             ReachesByDistance, ReachesByIndex, SavesCompact, SavesSome, Pauses, WaitsForWrite, OrdersMemory,
             ApproximatesRoots, ApproximatesReciprocal, ApproximatesBetter, OldSine)
