"""`/metrics`: values for a Prometheus server. Queries no device and waits for no run."""

from __future__ import annotations

from typing import Annotated

from fastapi import Header, Request, Response

from station.people import Permission
from web.guarded import Router, needs
from web.metrics import Metrics

router = Router(tags=["health"])


class MetricsText(Response):
    media_type = "text/plain"


@router.get("/metrics", response_class=MetricsText, dependencies=[needs(Permission.READ)])
def read_metrics(request: Request, accept: Annotated[str, Header()] = "") -> MetricsText:
    """In Prometheus' text format, or in that of OpenMetrics if requested."""
    metrics: Metrics = request.app.state.metrics
    content_type, text = metrics.exposed(accept)
    return MetricsText(text, headers={"Content-Type": content_type})
