"""Connections that end: uvicorn itself waits for ever for a request that does not come or does not end."""

from __future__ import annotations

import asyncio
from typing import Any

from uvicorn.protocols.http.auto import AutoHTTPProtocol


class Connection(AutoHTTPProtocol):  # type: ignore[misc, valid-type]
    """A connection that is closed when no whole head of a request arrives in time, however slowly its bytes
    come.
    """

    patience = 20.0  # seconds
    loop: asyncio.AbstractEventLoop
    transport: Any
    cycle: Any
    _end: asyncio.TimerHandle | None = None

    def connection_made(self, transport: Any) -> None:
        """Give the first request its time."""
        super().connection_made(transport)
        self._end = self.loop.call_later(self.patience, self._close)

    def data_received(self, data: bytes) -> None:
        """Stop the clock while a request is answered; after that uvicorn's own keep-alive holds, until the
        next request begins.
        """
        super().data_received(data)
        if self.cycle is not None and not self.cycle.response_complete:
            self._stop()
        elif self._end is None:
            self._end = self.loop.call_later(self.patience, self._close)

    def connection_lost(self, exc: Exception | None) -> None:
        """Forget the clock."""
        self._stop()
        super().connection_lost(exc)

    def _stop(self) -> None:
        if self._end is not None:
            self._end.cancel()
            self._end = None

    def _close(self) -> None:
        self._end = None
        if not self.transport.is_closing():
            self.transport.close()
