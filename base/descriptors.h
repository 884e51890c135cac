// How many files and connections a process may have open.
#pragma once

namespace lfd {

// As many as the system lets this user have: a thousand connections of strangers then leave room for our own. Call it
// before threads start.
void raise_descriptor_limit();

}  // namespace lfd
