# Installed later in this file's life: see cmake/install.cmake in the set-up commit.
