// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>

namespace lacuna::cad_worker {

/// Take from the process, for good, to write, make or remove any file by name, where the kernel has Landlock.
/// For the time before `confine()`: libraries that come with Gmsh write preferences as it starts.
void keep_from_writing();

/// Take from the process, for good, what reading and writing CAD needs not: starting programs, processes
/// and sockets, changing its limits, opening any file for writing; where the kernel has Landlock, also
/// reading any file but the system's libraries. Files of a request are opened by the names `offer()` gave
/// them.
///
/// Every path that is opened or looked at is trapped by a seccomp filter and decided in a SIGSYS
/// handler: names of offered files lead to their descriptors, other files can be opened
/// to read.
///
/// @return  what this kernel lacks, for a person; empty where all is there.
/// @throw BackendError  the kernel has no seccomp filters, without which nothing is run.
std::string confine();

/// Write the filter of `confine()` as libseccomp's pseudo filter code, for tests.
/// @return  false where that failed.
bool write_filter(int descriptor);

/// Make a descriptor known under a name; it stays open until `withdraw()`.
/// @return  the path by which this process, and no other, opens it: to read, or to write it anew.
std::string offer(const std::string& folder, const std::string& name, int descriptor);
/// Forget every name in a folder.
void withdraw(const std::string& folder);

} // namespace lacuna::cad_worker
