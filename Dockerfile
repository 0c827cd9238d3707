# One image for the API, the relay and the workers; the kernels of every preset are compiled in it.
FROM python:3.12-slim

# Kernels are compiled for a named level of processor, so that they load on any machine that has
# it: x86-64-v3 is any with AVX2 and FMA (2013 and later). On Arm: --build-arg PROCESSOR=generic
ARG PROCESSOR=x86-64-v3
ENV NUMBA_CPU_NAME=${PROCESSOR} \
    NUMBA_CPU_FEATURES="" \
    JOINTPLAY_CACHE=/opt/jointplay/kernels \
    JOINTPLAY_DATA=/data \
    PYTHONSAFEPATH=1 \
    PYTHONUNBUFFERED=1

WORKDIR /opt/jointplay
COPY pyproject.toml README.md LICENSE ./
COPY src src
COPY solver solver
COPY scenes scenes
COPY storage storage
COPY worker worker
COPY service service
COPY records records
COPY figures figures
COPY page page
RUN pip install --no-cache-dir '.[cluster]'

RUN useradd --create-home jointplay && mkdir -p /data kernels && chown jointplay /data kernels
USER jointplay
WORKDIR /home/jointplay
RUN python -m jointplay.worker.warm && python -m jointplay.worker.warm --check

VOLUME /data
EXPOSE 8000
CMD ["python", "-m", "jointplay.service.processes.api", "--host", "0.0.0.0", "--port", "8000"]
