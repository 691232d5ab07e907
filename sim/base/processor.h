// Whether this machine's processor can run what this program was compiled for.
#pragma once

namespace vegard::sim {

/// Throws Error(usage) if the processor lacks the instruction set of the vector code. A program built for all
/// processors needs SSE4.2, one built for a single machine (VEGARD_INSTRUCTION_SETS=this) what that machine had.
/// Every program calls it before anything else: without it such a program would end by an illegal instruction.
void check_processor();

}  // namespace vegard::sim
