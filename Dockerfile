# Drystone on a bare Debian 12:  docker build -t drystone . && docker run -v "$PWD:/case" -w /case drystone limitAnalysis
# Apptainer makes an image of it by:  apptainer build drystone.sif docker-daemon://drystone:latest
FROM debian:12 AS build
COPY . /drystone
WORKDIR /drystone
RUN etc/bootstrap run \
    && cmake --preset release -D DRYSTONE_TESTS=OFF -D DRYSTONE_PROCESSOR=x86-64 \
    && cmake --build --preset release --target applications \
    && cd build && cpack -G DEB

FROM debian:12
COPY --from=build /drystone/build/drystone_*.deb /tmp/
RUN apt-get update && apt-get install --yes --no-install-recommends /tmp/drystone_*.deb \
    && rm -rf /var/lib/apt/lists/* /tmp/drystone_*.deb
CMD ["bash"]
