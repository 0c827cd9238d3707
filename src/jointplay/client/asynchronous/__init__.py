"""The client for event loops: every verb of the blocking one, awaited.

`bridge` runs blocking code in a greenlet that hands what it waits for to the event loop, so that
nothing of the client is told twice: `verbs` makes awaited methods of blocking ones.
"""
