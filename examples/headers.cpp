// Nothing of its own: where the headers that all programs include are compiled once (CMakeLists.txt).
