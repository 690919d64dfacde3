"""The web app: a FastAPI server that publishes the declarations as JSON, and a small front end without a
build step.
"""
