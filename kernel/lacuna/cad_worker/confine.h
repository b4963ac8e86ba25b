// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>

namespace lacuna::cad_worker {

/// Permanently prevent this process from creating, writing or removing files by name, if the kernel supports
/// Landlock. Called before Gmsh starts, whose libraries write preferences; `confine()` follows.
void keep_from_writing();

/// Permanently remove the rights that reading and writing CAD does not need: starting programs, processes and
/// sockets, changing limits, opening files for writing; with Landlock also reading files other than the
/// system libraries. The files of a request are opened by the names that `offer()` returns.
///
/// A seccomp filter traps every call that opens or inspects a path, and a SIGSYS handler decides: the name of
/// an offered file leads to its descriptor, other files can only be opened for reading.
///
/// @return  the protection that the Linux kernel lacks, and its purpose, as text; empty if none.
/// @throw BackendError  the kernel has no seccomp filters; CAD files are then not read at all.
std::string confine();

/// Write the filter of `confine()` in the pseudo filter code of libseccomp, for tests.
/// @return  false where that failed.
bool write_filter(int descriptor);

/// Give a descriptor a name; it stays open until `withdraw()`.
/// @return  the path by which only this process can open it, for reading or for overwriting.
std::string offer(const std::string& folder, const std::string& name, int descriptor);
/// Remove all names in a folder.
void withdraw(const std::string& folder);

} // namespace lacuna::cad_worker
