# What is installed where (the prefix is the root of the file system), and the Debian package: cpack -G DEB, after a build.
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)  # tests are not part of it
if(CMAKE_INSTALL_PREFIX_INITIALIZED_TO_DEFAULT)
  set(CMAKE_INSTALL_PREFIX / CACHE PATH "Root of the file system" FORCE)
endif()

install(DIRECTORY configs/ DESTINATION usr/share/lfd/configs PATTERN systemd EXCLUDE)
install(FILES cmake/package/deployment.textproto DESTINATION etc/lfd)
install(FILES configs/systemd/lfd-controller.service configs/systemd/lfd-display.service
              configs/systemd/lfd-rendernode@.service DESTINATION lib/systemd/system)
install(FILES configs/systemd/lfd.sysusers DESTINATION usr/lib/sysusers.d RENAME lfd.conf)
install(DIRECTORY proto/ DESTINATION usr/share/lfd/proto FILES_MATCHING PATTERN "*.proto" PATTERN wire EXCLUDE
                                                                        PATTERN pictures EXCLUDE PATTERN occlusion EXCLUDE
                                                                        PATTERN images EXCLUDE)
# To be read: the programs hold them.
install(DIRECTORY shaders/ DESTINATION usr/share/lfd/shaders
        FILES_MATCHING PATTERN "*.glsl" PATTERN "*.vert" PATTERN "*.frag" PATTERN "*.comp" PATTERN "*.tesc"
                       PATTERN "*.tese" REGEX "/shared/[^/]+[.]h$")
install(DIRECTORY docs DESTINATION usr/share/doc/lfd)
install(FILES README.md DESTINATION usr/share/doc/lfd)
# What it names.
install(FILES proto/README.md DESTINATION usr/share/doc/lfd/proto)
install(DIRECTORY bench/results DESTINATION usr/share/doc/lfd/bench FILES_MATCHING PATTERN "*.md" PATTERN "*.svg")
install(FILES cmake/package/copyright DESTINATION usr/share/doc/lfd)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME lfd)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT "the developers of lfd <lfd@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Driver for projector-based light-field displays")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
"Controller, render nodes and a virtual display for light-field displays of
the HoloVizio class, and what is needed to calibrate, measure and watch them.
Units of systemd are included and started by nobody: edit
/etc/lfd/deployment.textproto first. The shaders in /usr/share/lfd/shaders are
there to be read; the programs hold their own.")
set(CPACK_PACKAGING_INSTALL_PREFIX /)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# libepoxy opens these while it runs, so no program names them.
set(CPACK_DEBIAN_PACKAGE_DEPENDS "libegl1, libopengl0 | libgl1, systemd | adduser")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "libegl-mesa0, libgl1-mesa-dri")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "prometheus")
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA
    ${CMAKE_SOURCE_DIR}/cmake/package/conffiles ${CMAKE_SOURCE_DIR}/cmake/package/postinst
    ${CMAKE_SOURCE_DIR}/cmake/package/prerm ${CMAKE_SOURCE_DIR}/cmake/package/postrm)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
include(CPack)
