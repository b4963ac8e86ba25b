// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>

namespace lacuna::cad_worker {

/// Permanently prevent this process from creating, writing or removing files by name, if the kernel supports
/// Landlock. Called before Gmsh starts, because Gmsh's libraries write preferences. `confine()` is called
/// later.
void keep_from_writing();

/// Permanently remove rights that reading and writing CAD files does not need: starting programs, processes
/// and sockets, changing limits, and opening files for writing. With Landlock, the process can read no other
/// files than the system libraries. The files of a request are opened by the names that `offer()` returns.
///
/// A seccomp filter traps every call that opens or inspects a path, and a SIGSYS handler answers it. The name
/// of an offered file leads to its descriptor; other files can be opened for reading only.
///
/// @return  as text, the protection that the Linux kernel lacks, and its purpose; empty if it lacks none.
/// @throw BackendError  the kernel has no seccomp filters. CAD files are then not read at all.
std::string confine();

/// Write the filter of `confine()` as pseudo code of libseccomp, for tests.
/// @return  false if that failed.
bool write_filter(int descriptor);

/// Give a descriptor a name; it stays open until `withdraw()`.
/// @return  the path by which only this process can open it, for reading or for overwriting.
std::string offer(const std::string& folder, const std::string& name, int descriptor);
/// Remove all names in a folder.
void withdraw(const std::string& folder);

} // namespace lacuna::cad_worker
